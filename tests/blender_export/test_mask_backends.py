# SPDX-License-Identifier: GPL-3.0-or-later
"""Every way to render masks against view layers, pixel by pixel, and what falls back to them."""

import unittest

from blender_case import BlenderCase

# A ball shaded smooth, boxes, a thin rod and all kinds of light; one light moves in frame 2.
SCENE = """
start(96, 72)
ground()
box("Box", (0.3, -0.8, 0), (1.1, 0.0, 1.2))
box("Slab", (-1.9, 0.8, 1.0), (0.2, 1.5, 1.1))
tools.tube("Rod", [[(-1.5, -1.5, 0.0, 0.04), (-1.2, -1.2, 2.0, 0.04)]], GREY)
ball = tools.revolve("Ball", [(0.6 * math.sin(math.pi * k / 24), 0.6 - 0.6 * math.cos(math.pi * k / 24))
                              for k in range(25)], GREY, 36)
ball.location = (-0.9, -0.4, 0.0)
key(light("Point", 'POINT', (-3, -2, 4), energy=500, shadow_soft_size=0.3), "location",
    f1=(-3, -2, 4), f2=(-2, -3, 4))
light("Spot", 'SPOT', (3, -2.5, 4.5), (38, 0, 45), energy=800, shadow_soft_size=0.25,
      spot_size=math.radians(40), spot_blend=0.2)
light("Sun", 'SUN', (0, 0, 5), (40, 0, -60), energy=2, angle=math.radians(6))
light("Area", 'AREA', (0, 3.5, 2.0), (-62, 0, 0), energy=300, shape='RECTANGLE', size=1.5, size_y=0.3)
tools.camera((0.0, -6.5, 4.2), (0.0, 0.0, 0.5), 50)
"""


class MaskBackends(BlenderCase):
    def masks(self, output, frame=1):
        """({layer: values}, {light: backend}) of an exported frame."""
        pixels, document = self.pixels(frame, output), self.document(frame, output)
        lights = [light for light in document["lights"] if "masks" in light]
        layers = {sample["layer"]: [value for row in pixels[sample["layer"] + ".V"] for value in row]
                  for light in lights for sample in light["masks"]["samples"]}
        return layers, {light["name"]: light["masks"]["by"] for light in lights}

    def exported(self, shot, by, *words, frame=1):
        said = self.export(shot, "--masks", "disc:5", "--masks-by", by, *words,
                           output=f"{by}/s.####.exr")
        layers, ways = self.masks(f"{by}/s", frame)
        return layers, ways, said

    def assert_close(self, found, wanted, share):
        """Only 0 and 1, and in at most `share` of a mask's pixels another value than wanted."""
        self.assertEqual(set(found), set(wanted))
        for layer, values in wanted.items():
            self.assertEqual(set(found[layer]), {0.0, 1.0}, layer)
            wrong = sum(a != b for a, b in zip(found[layer], values))
            self.assertLessEqual(wrong, share * len(values), layer)

    def test_every_way_gives_the_masks_of_layers_in_every_frame(self):
        shot = self.build(SCENE)
        frames = ("--frames", "1-2")
        _, ways, _ = self.exported(shot, "layers", *frames)
        self.assertEqual(set(ways.values()), {"layers"})
        _, ways, said = self.exported(shot, "auto", *frames)
        self.assertLessEqual(set(ways.values()), {"occlusion", "raycast"})
        self.assertEqual(self.notes(said), [])
        _, ways, _ = self.exported(shot, "groups", *frames)
        self.assertEqual(set(ways.values()), {"groups"})
        for frame in (1, 2):
            wanted, _ = self.masks("layers/s", frame)
            # Rays differ where smooth faces turn away, groups where an edge goes through a pixel's
            # centre, round which their samples lie.
            self.assert_close(self.masks("auto/s", frame)[0], wanted, 1e-3)
            self.assert_close(self.masks("groups/s", frame)[0], wanted, 1e-3)
        self.assertNotEqual(self.masks("auto/s", 1)[0]["mask.Point.0"],
                            self.masks("auto/s", 2)[0]["mask.Point.0"])


if __name__ == "__main__":
    unittest.main()
