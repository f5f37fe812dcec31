# SPDX-License-Identifier: GPL-3.0-or-later
import unittest

from paths import exporter

frame_ranges, errors = exporter("frame_ranges"), exporter("errors")


class FrameRanges(unittest.TestCase):
    def test_single_frames_ranges_steps_and_lists(self):
        for text, frames in (("7", [7]), ("1-4", [1, 2, 3, 4]), ("4-1", [4, 3, 2, 1]),
                             ("1-10x4", [1, 5, 9]), ("1-10:4", [1, 5, 9]), ("1..3", [1, 2, 3]),
                             ("10-1x4", [10, 6, 2]), ("-3--1", [-3, -2, -1]), ("-1-1", [-1, 0, 1]),
                             ("1,5 9", [1, 5, 9]), ("1-3,2-4", [1, 2, 3, 4])):
            with self.subTest(text):
                self.assertEqual(frame_ranges.parse_frames(text), frames)

    def test_anything_else_is_refused(self):
        for text in ("", " ", "abc", "1-", "-", "1-5:2x", "1-5x0", "1.5", "1-5;7", "1--"):
            with self.subTest(text):
                with self.assertRaises(errors.UsageError):
                    frame_ranges.parse_frames(text)

    def test_absurd_ranges_are_refused_before_they_fill_memory(self):
        with self.assertRaises(errors.UsageError):
            frame_ranges.parse_frames("1-99999999999")


if __name__ == "__main__":
    unittest.main()
