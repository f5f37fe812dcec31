# SPDX-License-Identifier: GPL-3.0-or-later
import unittest

from paths import exporter

arguments, errors = exporter("arguments"), exporter("errors")


class Arguments(unittest.TestCase):
    def test_defaults(self):
        options = arguments.parse_arguments(["--output", "a/shot.####.exr"])
        self.assertEqual((options.masks.kind, options.masks.count), ("disc", 9))
        self.assertEqual((options.frames, options.lights, options.offset), (None, [], None))
        self.assertEqual((options.truth_samples, options.scale, options.depth_size), (0, 1, 1024))

    def test_everything_at_once(self):
        options = arguments.parse_arguments(
            "--output a.exr --frames 1-3 --light Key --light Rim --masks line:7 --offset 0.25 "
            "--truth 512 --scale 2 --percentage 50".split())
        self.assertEqual(options.frames, [1, 2, 3])
        self.assertEqual(options.lights, ["Key", "Rim"])
        self.assertEqual((options.masks.kind, options.masks.count), ("line", 7))
        self.assertEqual((options.offset, options.truth_samples, options.scale), (0.25, 512, 2))
        self.assertEqual(options.percentage, 50)

    def test_discs_of_many_masks(self):
        for count in (5, 9, 17, 33, 65):
            masks = arguments.parse_masks(f"disc:{count}")
            self.assertEqual((masks.kind, masks.count), ("disc", count))
        for words in ("disc:8", "disc:16", "disc:129", "disc:09", "disc:-9"):
            with self.subTest(words), self.assertRaises(errors.UsageError):
                arguments.parse_masks(words)

    def test_traced_shadows_take_the_place_of_masks(self):
        masks = arguments.parse_masks("trace:64")
        self.assertEqual((masks.kind, masks.count), ("trace", 64))
        for words in ("trace", "trace:0", "trace:65537", "trace:-1", "trace:1.5"):
            with self.subTest(words), self.assertRaises(errors.UsageError):
                arguments.parse_masks(words)

    def test_ways_to_render_masks(self):
        self.assertEqual(arguments.parse_arguments(["--output", "a.exr"]).masks_by, "auto")
        for by in ("auto", "layers", "groups", "occlusion", "raycast"):
            words = ["--output", "a.exr", "--masks-by", by]
            self.assertEqual(arguments.parse_arguments(words).masks_by, by)
        with self.assertRaisesRegex(errors.UsageError, "did you mean 'layers'"):
            arguments.parse_backend("layer")

    def test_wrong_values_are_refused(self):
        for words in ("", "--output", "--output a.exr --masks disc:6", "--output a.exr --masks disc",
                      "--output a.exr --masks line:1", "--output a.exr --masks line:65",
                      "--output a.exr --masks pair:2", "--output a.exr --offset 0",
                      "--output a.exr --offset -1", "--output a.exr --offset nan",
                      "--output a.exr --offset inf", "--output a.exr --truth 0",
                      "--output a.exr --scale 9", "--output a.exr --percentage 0",
                      "--output a.exr --percentage 101", "--output a.exr --scale 1.5",
                      "--output a.exr --mask pair", "--output a.exr stray"):
            with self.subTest(words), self.assertRaises(errors.UsageError):
                arguments.parse_arguments(words.split())

    def test_the_nearest_arrangement_is_named(self):
        with self.assertRaisesRegex(errors.UsageError, "did you mean 'pair'"):
            arguments.parse_masks("pairs")


if __name__ == "__main__":
    unittest.main()
