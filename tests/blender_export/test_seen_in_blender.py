# SPDX-License-Identifier: GPL-3.0-or-later
"""What the export leaves out, cuts or lays over, says, and how masks follow each lamp's shape."""

import math
import unittest

from blender_case import BlenderCase

EVERYTHING = """
scene = start(40, 40)
ground()
box("Box", (-0.5, -0.5, 0), (0.5, 0.5, 1.2))
box("Held", (1.2, -0.5, 0), (2.0, 0.5, 1.2)).is_holdout = True
box("Caught", (-2.0, -0.5, 0), (-1.2, 0.5, 1.2)).is_shadow_catcher = True
aside = bpy.data.collections.new("Aside")
scene.collection.children.link(aside)
bounce = box("Bounce", (-0.4, -3.0, 0), (0.4, -2.6, 1.0))
scene.collection.objects.unlink(bounce)
aside.objects.link(bounce)
layer = bpy.context.view_layer
layer.layer_collection.children["Aside"].indirect_only = True
light("Point", 'POINT', (-2, -2, 4), energy=300, shadow_soft_size=0.0)
light("Tube", 'AREA', (2, -2, 4), (-30, 30, 0), energy=100, shape='ELLIPSE', size=0.4, size_y=2.5)
eye = tools.camera((0, -7, 3), (0, 0, 0.5), 50)
eye.data.dof.use_dof = True
eye.data.dof.aperture_fstop = 0.5
render = scene.render
render.use_border = render.use_multiview = render.use_motion_blur = render.use_freestyle = True
render.film_transparent = True
layer.use_pass_mist = True
if hasattr(scene, "compositing_node_group"):
    scene.compositing_node_group = bpy.data.node_groups.new("Grade", 'CompositorNodeTree')
else:
    scene.use_nodes = True  # with nodes whose passes come and go
other = scene.view_layers.new("Sketch")
sets = layer.freestyle_settings.linesets
for lines in sets or [sets.new("Lines")]:
    lines.linestyle = bpy.data.linestyles.new("Line")
layer.freestyle_settings.as_render_pass = False
"""

LIBRARY = """
scene = start()
box("Body", (-1.5, -0.5, 0), (-0.5, 0.5, 1.0), tools.material("Skin", (0.8, 0.4, 0.3)))
"""

LINKED = """
scene = start()
ground()
with bpy.data.libraries.load({path!r}, link=True) as (source, target):
    target.objects = ["Body"]
scene.collection.objects.link(target.objects[0])
box("Body", (0.5, -0.5, 0), (1.5, 0.5, 1.0), tools.material("Skin", (0.2, 0.4, 0.8)))
light("Key", 'POINT', (-2, -2, 4), energy=300, shadow_soft_size=0.3)
tools.camera((0, -7, 3), (0, 0, 0.5), 50)
"""


class Seen(BlenderCase):
    def test_what_is_left_out_is_said_once_and_what_is_cut_is_marked(self):
        said = self.notes(self.export(self.build(EVERYTHING), "--frames", "1,2", "--masks",
                                      "disc:5", "--scale", "2"))
        for words in ("render border is ignored", "stereo is ignored", "not Sketch", "Mist pass", "compositing is not",
                      "depth of field", "motion blur", "80x80 pixels", "no size"):
            self.assertEqual(len([note for note in said if words in note]), 1, (words, said))
        document, pixels = self.document(1), self.pixels(1)
        objects = {item["name"]: item for item in document["objects"]}
        self.assertEqual({name for name, item in objects.items() if not item.get("painted", True)},
                         {"Held", "Caught"})
        seen = {value for row in pixels["data.IndexOB.V"] for value in row}
        self.assertNotIn(float(objects["Bounce"]["index"]), seen)
        self.check_lines(document, pixels)
        self.check_masks({light["name"]: light for light in document["lights"]})

    def check_lines(self, document, pixels):
        self.assertEqual(document["layers"]["lines"], "beauty.Freestyle")
        drawn = sum(value > 0.5 for row in pixels["beauty.Freestyle.A"] for value in row)
        self.assertGreater(drawn, 30)

    def check_masks(self, lights):
        hard = lights["Point"]["masks"]
        self.assertEqual((hard["arrangement"], len(hard["samples"])), ("hard", 1))
        tube = lights["Tube"]
        self.assertAlmostEqual(tube["masks"]["offset"], 1.25, 5)
        self.assertAlmostEqual(tube["masks"]["offset_v"], 0.2, 5)
        for sample in tube["masks"]["samples"]:
            wanted = [p + 1.25 * sample["uv"][0] * a + 0.2 * sample["uv"][1] * b for p, a, b in
                      zip(tube["position"], tube["axes"]["u"], tube["axes"]["v"])]
            self.assertLess(math.dist(sample["position"], wanted), 1e-5)

    def test_things_of_one_name_are_told_apart_by_their_library(self):
        library = self.build(LIBRARY, "cast.blend")
        self.export(self.build(LINKED.format(path=library)), "--frames", "1", "--masks", "line:2")
        document, pixels = self.document(1), self.pixels(1)
        objects = {item["name"]: item for item in document["objects"]}
        self.assertEqual(set(objects), {"Body", "Body [cast.blend]", "Ground"})
        self.assertEqual(objects["Body [cast.blend]"]["materials"], ["Skin [cast.blend]"])
        self.assertEqual(objects["Body"]["materials"], ["Skin"])
        seen = {value for row in pixels["data.IndexOB.V"] for value in row}
        self.assertTrue({float(item["index"]) for item in objects.values()} <= seen)


if __name__ == "__main__":
    unittest.main()
