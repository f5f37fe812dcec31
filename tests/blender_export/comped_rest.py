# SPDX-License-Identifier: GPL-3.0-or-later
"""Strokes on skin, hair and instances of a real export, comped in every order."""

import subprocess
import unittest

from comp_case import KAGEFUDE, CompCase

# A bending arm with a breathing shape and hair, and two instances of a leaf that sways.
SKIN = """
scene = start(64, 48)
scene.frame_start, scene.frame_end = 1, 4
ground()
arm = tools.tube("Arm", [[(0.1 * math.sin(k), 0, 0.1 * k, 0.3) for k in range(13)]], GREY, 16)
arm.shape_key_add(name="Basis")
wide = arm.shape_key_add(name="Wide")
for point in wide.data:
    point.co.x *= 1.3
key(wide, "value", f1=0.0, f4=1.0)
bend = arm.modifiers.new("Bend", 'SIMPLE_DEFORM')
bend.deform_method, bend.deform_axis = 'BEND', 'Y'
key(bend, "angle", f1=-0.4, f4=0.8)
top = arm.vertex_groups.new(name="Top")
top.add([point.index for point in arm.data.vertices if point.co.z > 0.8], 1.0, 'REPLACE')
hair = arm.modifiers.new("Hair", 'PARTICLE_SYSTEM').particle_system
hair.vertex_group_density = "Top"
hair.settings.type, hair.settings.count, hair.settings.hair_length = 'HAIR', 60, 0.4
hair.settings.root_radius, hair.settings.radius_scale = 0.06, 1.0
aside = bpy.data.collections.new("Aside")
leaf = box("Leaf", (-0.3, -0.05, 0), (0.3, 0.05, 0.6))
scene.collection.objects.unlink(leaf)
aside.objects.link(leaf)
for name, place in (("One", -1.4), ("Two", 1.4)):
    shown = bpy.data.objects.new(name, None)
    shown.instance_type, shown.instance_collection, shown.location = 'COLLECTION', aside, (place, 0, 0)
    scene.collection.objects.link(shown)
    key(shown, "rotation_euler", f1=(0, 0, 0), f4=(0, 0.5, 0.3))
light("Key", 'POINT', (-2, -4, 4), energy=300, shadow_soft_size=0.3)
tools.camera((0, -7, 2), (0, 0, 0.8), 50)
"""

LOOK = """
kagefude = 1
[output]
layers = ["brush.tone"]
[[style]]
object = "*"
strip = "builtin:fine"
"""


class CompedRest(CompCase):
    def bytes_of(self, to):
        found = []
        for frame in range(1, 5):
            with open(self.path(f"{to}.{frame:04}.exr"), "rb") as file:
                found.append(file.read())
        return found

    def comp_frames(self, to, *words):
        result = subprocess.run(
            [KAGEFUDE, "comp", self.path("look.toml"), self.path("out/s.####.exr"), "-o",
             self.path(f"{to}.####.exr"), "--progress", "none", *words],
            capture_output=True, text=True, timeout=300)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_frames_in_any_order_have_the_same_bytes(self):
        self.export(self.build(SKIN), "--frames", "1-4", "--masks", "disc:5")
        self.comp(look=LOOK, to="forward/c")
        forward = self.bytes_of("forward/c")
        self.assertEqual(len(set(forward)), 4)
        self.comp_frames("back/c", "--frames", "4-1", "--frames-at-once", "1", "--threads", "1")
        for frame in (3, 1, 4, 2):
            self.comp_frames("alone/c", "--frames", str(frame))
        for way in ("back", "alone"):
            for frame, (one, other) in enumerate(zip(forward, self.bytes_of(f"{way}/c")), 1):
                self.assertTrue(one == other, f"frame {frame} differs: {way}")


if __name__ == "__main__":
    unittest.main()
