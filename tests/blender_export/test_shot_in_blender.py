# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing depends on what one frame happens to see: each frame's lights and the shot's own values."""

import math
import unittest

from blender_case import BlenderCase, blender_says

ROLLING_BALL = """
scene = start()
ground()
box("Box", (-0.5, -0.5, 0), (0.5, 0.5, 1.2))
bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5)
ball = bpy.context.object
ball.name = "Ball"
for frame, x in ((1, -9.0), (12, 1.5)):
    ball.location = (x, 0.2, 0.5)
    ball.keyframe_insert("location", frame=frame)
light("Key", 'POINT', (-2, -2, 4), energy=300, shadow_soft_size=0.3)
light("Sun", 'SUN', (0, 0, 5), (40, 0, -60), energy=1.0, angle=0.1)
tools.camera((0, -7, 3), (0, 0, 0.5), 50)
scene.frame_start, scene.frame_end = 1, 12
"""

LAMPS = """
scene = start()
ground()
box("Box", (-0.5, -0.5, 0), (0.5, 0.5, 1.2))
key(light("Off", 'POINT', (-2, -2, 4), energy=100, shadow_soft_size=0.3), "hide_render", f1=False, f2=True)
key(light("Late", 'POINT', (-2, -1, 4), energy=100, shadow_soft_size=0.3), "hide_render", f1=True, f3=False)
key(light("Fading", 'POINT', (2, -2, 4), energy=100, shadow_soft_size=0.3).data, "energy", f1=100.0, f3=0.0)
dimmed = light("Dimmed", 'SPOT', (2, -2, 4), energy=100, spot_size=2.0, shadow_soft_size=0.3)
dimmed.data.use_nodes = True
emission = dimmed.data.node_tree.nodes["Emission"]
emission.inputs["Color"].default_value = (1.0, 0.5, 0.25, 1.0)
key(emission.inputs["Strength"], "default_value", f1=1.0, f3=0.25)
light("Dark", 'POINT', (1, -1, 4), energy=0.0)
light("Never", 'POINT', (1, -2, 4), energy=50.0).hide_render = True
fill = light("Fill", 'AREA', (0, -3, 4), (30, 0, 0), energy=20, shape='ELLIPSE', size=0.4, size_y=2.0)
fill.data.use_shadow, fill.data.spread = False, 1.0
if hasattr(fill.data.cycles, "cast_shadow"):  # Cycles' own switch, before Blender 4.2
    fill.data.cycles.cast_shadow = False
tools.camera((0, -7, 3), (0, 0, 0.5), 50)
scene.frame_start, scene.frame_end = 1, 3
"""


class RollingBall(BlenderCase):
    def test_a_ball_that_rolls_into_view_changes_nothing_but_itself(self):
        self.export(self.build(ROLLING_BALL), "--frames", "1-12x3,12", "--masks", "line:2")
        documents = [self.document(frame) for frame in (1, 4, 7, 10, 12)]
        for document in documents[1:]:
            self.assertEqual(document["lights"], [
                {**light, "depth_map": there["depth_map"]} for light, there in
                zip(documents[0]["lights"], document["lights"])])
            self.assertEqual(document["shot"], documents[0]["shot"])
            self.assertEqual([item for item in document["objects"] if item["name"] != "Ball"],
                             [item for item in documents[0]["objects"] if item["name"] != "Ball"])
        shot = documents[0]["shot"]
        self.assertEqual((shot["first"], shot["last"]), (1, 12))
        self.assertEqual([light["name"] for light in shot["lights"]], ["Key", "Sun"])

    def test_any_chunk_says_the_same_of_the_shot(self):
        shot = self.build(ROLLING_BALL)
        self.export(shot, "--frames", "9", "--masks", "line:2", output="a/s.####.exr")
        self.export(shot, "--frames", "12,9", "--masks", "line:2", output="b/s.####.exr")
        self.assertEqual(self.document(9, "a/s"), self.document(9, "b/s"))


class Lamps(BlenderCase):
    @classmethod
    def lights(cls, document):
        return {light["name"]: light for light in document["lights"]}

    def test_lights_are_as_they_are_in_their_frame(self):
        said = self.export(self.build(LAMPS), "--frames", "3,1,2", "--masks", "line:2")
        frames = {frame: self.lights(self.document(frame)) for frame in (1, 2, 3)}
        fill = 20.0 if blender_says("bpy.app.version < (4, 0, 0)") else 20.0 * 4.0 / math.pi
        for lights in frames.values():
            self.assertEqual(list(lights), ["Dimmed", "Fading", "Fill", "Late", "Off"])
        for name, energies in (("Off", (100.0, 0.0, 0.0)), ("Late", (0.0, 0.0, 100.0)),
                               ("Fading", (100.0, 50.0, 0.0)), ("Dimmed", (100.0, 62.5, 25.0)),
                               ("Fill", (fill, fill, fill))):
            found = tuple(frames[frame][name]["energy"] for frame in (1, 2, 3))
            for one, other in zip(found, energies):
                self.assertAlmostEqual(one, other, 3, (name, found))
        self.assertEqual(frames[1]["Dimmed"]["color"], [1.0, 0.5, 0.25])
        notes = [note for note in self.notes(said) if "'Fill'" in note]
        self.assertEqual(len(notes), 2)
        self.assertIn("a spread of less than 180 degrees", notes[0])
        self.assertIn("casts no shadow", notes[1])

    def test_a_lamp_without_shadow_keeps_its_shade(self):
        self.export(self.build(LAMPS), "--frames", "1", "--masks", "line:2")
        lights = self.lights(self.document(1))
        self.assertFalse(lights["Fill"]["shadow"])
        self.assertNotIn("masks", lights["Fill"])
        self.assertTrue(lights["Off"]["shadow"])
        self.assertEqual(len(lights["Off"]["masks"]["samples"]), 2)
        area = lights["Fill"]["area"]
        self.assertEqual(area["shape"], "ellipse")
        self.assertAlmostEqual(area["half_u"], 1.0, 5)
        self.assertAlmostEqual(area["half_v"], 0.2, 5)


if __name__ == "__main__":
    unittest.main()
