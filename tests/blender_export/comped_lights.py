# SPDX-License-Identifier: GPL-3.0-or-later
"""Lights in comps of real renders: each paints what it gives in its frame, as Cycles itself has it."""

import math
import unittest

from blender_case import blender_says
from comp_case import CompCase, flat, inside, rmse

# White and matte throughout, so that the direct diffuse light is the irradiance over pi.
STAGE = """
scene = start(64, 48)
scene.cycles.samples, scene.cycles.light_sampling_threshold = 64, 0.0
# As data and masks: at the pixels' centres.
scene.cycles.pixel_filter_type, scene.cycles.filter_width = 'GAUSSIAN', 0.01
scene.view_layers[0].use_pass_diffuse_direct = True
nodes, links = GREY.node_tree.nodes, GREY.node_tree.links
matte = nodes.new('ShaderNodeBsdfDiffuse')
links.new(matte.outputs[0], nodes["Material Output"].inputs["Surface"])
ground()
tools.camera((0.3, -7, 5), (0, 0.5, 0), 50)
scene.frame_start, scene.frame_end = 1, 6
"""

# On, half, off by its energy, off by its switch, dimmed and off by its nodes.
FRAMES_OF_LAMP = (1.0, 0.5, 0.0, 0.0, 0.25, 0.0)
LAMP = """
lamp = light("Key", 'POINT', (-2, -1, 4), energy=300, shadow_soft_size=0.05)
key(lamp.data, "energy", f1=300.0, f2=150.0, f3=0.0, f4=300.0)
key(lamp, "hide_render", f1=False, f3=False, f4=True, f5=False)
lamp.data.use_nodes = True
strength = lamp.data.node_tree.nodes["Emission"].inputs["Strength"]
key(strength, "default_value", f1=1.0, f4=1.0, f5=0.25, f6=0.0)
"""

# Beside and across the picture's middle: its plane crosses the ground from edge to edge.
AREA = """
light("Key", 'AREA', (0.5, 0.8, 0.8), (0, 60, 20), energy=60, size=0.05)
"""

SPOT = """
light("Key", 'SPOT', (-2, -1, 4), (20, -25, 0), energy=300, shadow_soft_size=0.02,
      spot_size=math.radians(50), spot_blend=0.4)
"""

SUN = """
light("Key", 'SUN', (0, 0, 4), (30, 20, 0), energy=2.0, angle=0.0, color=(1.0, 1.0, 1.0))
"""

NO_SHADOW = """
box("Box", (-0.5, -0.5, 0), (0.5, 0.5, 1.2))
lamp = light("Key", 'POINT', (-2, -1, 4), energy=300, shadow_soft_size=0.05)
lamp.data.use_shadow = False
if hasattr(lamp.data.cycles, "cast_shadow"):
    lamp.data.cycles.cast_shadow = False
"""


class CompedLights(CompCase):
    def exported_shot(self, lines, frames="1"):
        self.export(self.build(STAGE + lines), "--frames", frames, "--masks", "disc:5")

    def compare(self, lines, own_share=lambda place, lamp: 1.0):
        """The tone is the irradiance that Cycles gives, as a share of the subject's most."""
        self.exported_shot(lines)
        self.comp('tone.light="irradiance"')
        pixels, lamp = self.pixels(1), self.document(1)["lights"][0]
        white = self.document(1)["shot"]["lights"][0]["largest_irradiance"]
        places = zip(*(flat(pixels[f"data.Position.{axis}"]) for axis in "XYZ"))
        pairs = [(tone, min(math.pi * direct / white / own_share(place, lamp), 1.0))
                 for tone, direct, place, whole in
                 zip(flat(self.comped(1)["brush.tone"]), flat(pixels["beauty.DiffDir.R"]), places,
                     inside(pixels["data.IndexOB.V"], pixels["data.Normal.Z"])) if whole]
        self.assertGreater(len(pairs), 2000)
        self.assertGreater(max(other for _, other in pairs), 0.5)
        self.assertLess(max(abs(one - other) for one, other in pairs), 0.01)

    def test_a_lamp_that_is_off_paints_nothing_and_a_dimmed_one_less(self):
        self.exported_shot(LAMP, "1-6")
        for setting in ("shade", "irradiance"):
            self.comp(f'tone.light="{setting}"', to=f"{setting}/c")
            tones = [flat(self.comped(frame, f"{setting}/c")["brush.tone"]) for frame in range(1, 7)]
            self.assertGreater(max(tones[0]), 0.3)
            for tone, share in zip(tones, FRAMES_OF_LAMP):
                # No lamp gives more than white.
                wrong = max(abs(one - share * full) for one, full in zip(tone, tones[0]) if full < 1.0)
                self.assertLess(wrong, 1e-5, (setting, share))

    def test_area_lights_shine_forward_as_in_cycles(self):
        self.compare(AREA)

    def test_spots_end_as_in_cycles(self):
        """Before 4.0 a spot falls off by the cosine to its axis as well."""
        def cosine(place, lamp):
            way = [one - other for one, other in zip(place, lamp["position"])]
            return sum(a * b for a, b in zip(way, lamp["direction"])) / math.hypot(*way)
        old = blender_says("bpy.app.version < (4, 0, 0)")
        self.compare(SPOT, cosine if old else lambda place, lamp: 1.0)

    def test_suns_shine_as_in_cycles(self):
        self.compare(SUN)

    def test_a_lamp_without_shadow_shades_as_in_cycles(self):
        self.compare(NO_SHADOW)


if __name__ == "__main__":
    unittest.main()
