# SPDX-License-Identifier: GPL-3.0-or-later
"""The artist's file and the open scene are the same after an export, however masks are rendered."""

import os
import re
import unittest

from blender_case import BlenderCase, blender

HERE = os.path.dirname(os.path.abspath(__file__))

SCENE = """
scene = start(24, 24)
tools.set_world((0.2, 0.3, 0.5), 0.5)
ground()
box("Box", (-0.5, -0.5, 0), (0.5, 0.5, 1.2), tools.material("Red", (0.8, 0.2, 0.1)))
lamp = light("Key", 'POINT', (-2, -2, 4), energy=300, shadow_soft_size=0.3)
lamp.data.use_nodes = True
light("Sun", 'SUN', (0, 0, 5), (40, 0, -60), energy=1.0, angle=0.1)
aside = bpy.data.collections.new("Aside")
scene.collection.children.link(aside)
bounce = box("Bounce", (-0.4, -2.6, 0), (0.4, -2.2, 0.8))
scene.collection.objects.unlink(bounce)
aside.objects.link(bounce)
bpy.context.view_layer.layer_collection.children["Aside"].indirect_only = True
sets = bpy.context.view_layer.freestyle_settings.linesets
for lines in sets or [sets.new("Lines")]:
    lines.linestyle = bpy.data.linestyles.new("Line")
scene.view_layers.new("Sketch")
scene.render.use_freestyle = scene.render.use_motion_blur = scene.render.use_border = True
key(lamp, "location", f1=(-2, -2, 4), f3=(2, -2, 4))
tools.camera((0, -7, 3), (0, 0, 0.5), 50)
scene.frame_set(2)
"""


class Untouched(BlenderCase):
    def check(self, shot, *words):
        def on_disk():
            with open(shot, "rb") as file:
                return file.read(), os.stat(shot).st_mtime_ns
        before = on_disk()
        result = blender(shot, "--python-exit-code", "1", "-P",
                         os.path.join(HERE, "check_untouched.py"), "--",
                         self.path("out/s.####.exr"), "--frames", "1,3", "--depth-size", "16", *words)
        said = result.stdout + result.stderr
        self.assertEqual(result.returncode, 0, said)
        self.assertGreater(int(re.search(r"untouched: (\d+) properties", said)[1]), 3000)
        self.assertEqual(on_disk(), before)
        self.assertTrue(os.path.exists(self.path("out/s.0003.json")))

    def test_by_every_backend(self):
        shot = self.build(SCENE)
        for words in (("--masks-by", "auto", "--casters"), ("--masks-by", "layers", "--truth", "4"),
                      ("--masks-by", "groups"), ("--masks", "trace:4")):
            with self.subTest(words):
                self.check(shot, *words)


if __name__ == "__main__":
    unittest.main()
