# SPDX-License-Identifier: GPL-3.0-or-later
"""What comps of real renders show: shadows as the artist's materials cast them, and only what is painted."""

import math
import unittest

from blender_case import blender_says
from comp_case import CompCase, flat, inside, rmse
from test_blockers_in_blender import ALPHA, FOG, HOLE, MOVED, STAGE
from test_seen_in_blender import LIBRARY, LINKED

# The ground white and matte, so that the direct diffuse light of the beauty is the irradiance over pi.
MATTE = """
scene.cycles.samples, scene.cycles.light_sampling_threshold = 256, 0.0
scene.cycles.pixel_filter_type, scene.cycles.filter_width = 'GAUSSIAN', 0.01
scene.cycles.transparent_max_bounces = 64
scene.view_layers[0].use_pass_diffuse_direct = True
matte = GREY.node_tree.nodes.new('ShaderNodeBsdfDiffuse')
GREY.node_tree.links.new(matte.outputs[0], GREY.node_tree.nodes["Material Output"].inputs["Surface"])
bpy.data.lights["Key"].shadow_soft_size = 0.25
"""

# Round leaves, as a texture cuts them.
LEAVES = HOLE + """
wave = leaf.nodes.new('ShaderNodeTexVoronoi')
wave.inputs["Scale"].default_value = 2.0
leaf.links.new(place.outputs["Object"], wave.inputs["Vector"])
leaf.links.new(wave.outputs["Distance"], left.inputs[0])
left.inputs[1].default_value = 0.45
leaf.links.new(left.outputs[0], shader.inputs["Alpha"])
"""

PAINTED = """
scene = start(64, 48)
scene.cycles.pixel_filter_type, scene.cycles.filter_width = 'GAUSSIAN', 0.01
ground()
box("Box", (-0.4, -0.5, 0), (0.4, 0.5, 1.2))
box("Held", (1.2, -0.5, 0), (2.0, 0.5, 1.2)).is_holdout = True
box("Caught", (-2.0, -0.5, 0), (-1.2, 0.5, 1.2)).is_shadow_catcher = True
aside = bpy.data.collections.new("Aside")
scene.collection.children.link(aside)
bounce = box("Bounce", (-0.4, -2.6, 0), (0.4, -2.2, 0.8))
scene.collection.objects.unlink(bounce)
aside.objects.link(bounce)
layer = bpy.context.view_layer
layer.layer_collection.children["Aside"].indirect_only = True
light("Key", 'POINT', (-2, -3, 4), energy=300, shadow_soft_size=0.2)
tools.camera((0, -7, 3), (0, 0, 0.5), 50)
scene.render.film_transparent = True
"""

LINES = """
scene.render.use_freestyle = True
sets = layer.freestyle_settings.linesets
for lines in sets or [sets.new("Lines")]:
    lines.linestyle = bpy.data.linestyles.new("Line")
    lines.linestyle.color = (0.0, 0.0, 1.0)
    lines.linestyle.thickness = 4.0
"""

# One flat colour a style, so that a pixel tells by which it was painted.
STYLES = """
kagefude = 1
[output]
layers = ["visibility.*"]
colour = "float"
[tone]
black = -1
white = 0
[[style]]
object = "*"
strip = "builtin:cel"
colour = "replace"
"""


class CompedShadows(CompCase):
    def light_on_ground(self, lines):
        """[(as comped, as Cycles renders the artist's materials)] over the ground, and all pixels."""
        self.export(self.build(STAGE + MATTE + lines), "--frames", "1", "--masks", "disc:17")
        self.comp('tone.light="irradiance"')
        pixels = self.pixels(1)
        white = self.document(1)["shot"]["lights"][0]["largest_irradiance"]
        ground = [whole and z < 0.01 for whole, z in
                  zip(inside(pixels["data.IndexOB.V"]), flat(pixels["data.Position.Z"]))]
        return [(tone, min(math.pi * direct / white, 1.0)) for tone, direct, there in
                zip(flat(self.comped(1)["brush.tone"]), flat(pixels["beauty.DiffDir.R"]), ground)
                if there]

    def check(self, lines):
        pairs = self.light_on_ground(lines)
        self.assertGreater(len(pairs), 1000)
        dark = [pair for pair in pairs if pair[1] < 0.05]
        self.assertGreater(len(dark), 20)
        self.assertLess(max(one for one, _ in dark), 0.05)
        self.assertLess(rmse(pairs), 0.02)

    def test_cards(self):
        self.check("")

    def test_cut_leaves(self):
        self.check(ALPHA)

    def test_leaves_of_a_texture(self):
        self.check(LEAVES)

    def test_displaced_surfaces(self):
        self.check(MOVED)

    def test_fog_darkens_nothing(self):
        self.export(self.build(STAGE + MATTE + FOG), "--frames", "1", "--masks", "disc:5")
        self.comp()
        self.assertEqual(set(flat(self.comped(1)["visibility.Key"])), {1.0})
        # Nor is the fog itself painted: the ground shows through it.
        self.assertGreater(min(flat(self.comped(1)["brush.tone"])), 0.3)


class CompedObjects(CompCase):
    def colours(self):
        """RGBA of every pixel to four digits, as comped and as in the beauty."""
        comp, pixels = self.comped(1), self.pixels(1)

        def rounded(channels, name):
            return list(zip(*([round(value, 4) for value in flat(channels[name + channel])]
                              for channel in "RGBA")))
        return rounded(comp, ""), rounded(pixels, "beauty.Combined.")

    def places_of(self):
        """{name: pixels that show it and nothing else}; '' is where nothing is."""
        names = {float(item["index"]): item["name"] for item in self.document(1)["objects"]}
        ids = self.pixels(1)["data.IndexOB.V"]
        return {name: [k for k, (found, whole) in enumerate(zip(flat(ids), self.whole(ids)))
                       if whole and found == index] for index, name in {0.0: "", **names}.items()}

    @staticmethod
    def whole(ids):
        return inside([[value + 1.0 for value in row] for row in ids])

    def test_only_what_is_painted_is_painted(self):
        self.export(self.build(PAINTED), "--frames", "1", "--masks", "disc:5")
        self.comp(look=STYLES)
        comp, beauty = self.colours()
        places = self.places_of()
        self.assertEqual(places["Bounce"], [])
        # A holdout leaves a hole in the data as well as in the picture; the sky ends above it.
        held = [k for k in places[""] + places["Held"] if k > places["Ground"][0] + 64]
        self.assertGreater(len(held), 20)
        self.assertEqual({comp[k][3] for k in held}, {0.0})
        self.assertGreater(len(places["Caught"]), 20)
        for k in places["Caught"] + held:
            self.assertEqual(comp[k], beauty[k])
        paint = {comp[k] for k in places["Ground"] + places["Box"]}
        self.assertEqual(len(paint), 1)
        self.assertEqual(paint & {beauty[k] for k in places["Ground"] + places["Box"]}, set())

    def test_lines_lie_whole_over_the_paint(self):
        self.export(self.build(PAINTED + LINES), "--frames", "1", "--masks", "disc:5")
        self.comp(look=STYLES)
        comp, _ = self.colours()
        full = [k for k, share in enumerate(flat(self.pixels(1)["beauty.Freestyle.A"]))
                if share > 0.999]
        self.assertGreater(len(full), 30)
        # Blender 5 turns their colour a little on its way.
        blue = 1.0 if blender_says("bpy.app.version < (5, 0, 0)") else 0.9998
        self.assertEqual({comp[k] for k in full}, {(0.0, 0.0, blue, 1.0)})

    def test_two_things_of_one_name_take_two_styles(self):
        library = self.build(LIBRARY, "cast.blend")
        self.export(self.build(LINKED.format(path=library)), "--frames", "1", "--masks", "line:2")
        said = self.comp(look=STYLES + """
[[style]]
object = "Body [cast.blend]"
priority = 1
strip = "builtin:fine"
colour = "replace"
""")
        self.assertNotIn("warning", said)
        comp, places = self.colours()[0], self.places_of()
        own, linked = ({comp[k] for k in places[name]} for name in ("Body", "Body [cast.blend]"))
        self.assertEqual(own, {comp[k] for k in places["Ground"]})
        self.assertEqual(own & linked, set())


if __name__ == "__main__":
    unittest.main()
