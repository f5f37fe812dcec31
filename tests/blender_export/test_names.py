# SPDX-License-Identifier: GPL-3.0-or-later
import os
import unittest

from paths import exporter

output_names, murmur3, errors = exporter("output_names"), exporter("murmur3"), exporter("errors")


class OutputNames(unittest.TestCase):
    def test_padding(self):
        for pattern, image in (("d/shot.####.exr", "shot.0012.exr"), ("d/shot.#.exr", "shot.0012.exr"),
                               ("d/shot.######.exr", "shot.000012.exr"), ("d/s_%03d.exr", "s_012.exr"),
                               ("d/##.exr", "12.exr"), ("d/one.exr", "one.exr")):
            with self.subTest(pattern):
                names = output_names.parse_output(pattern, 1)
                self.assertEqual(names.image(12), image)
                self.assertEqual(names.folder, os.path.abspath("d"))

    def test_negative_frames_keep_their_digits(self):
        self.assertEqual(output_names.parse_output("s.####.exr", 1).image(-7), "s.-0007.exr")

    def test_companions(self):
        names = output_names.parse_output("d/shot.####.exr", 3)
        self.assertEqual(names.sidecar(12), "shot.0012.json")
        self.assertEqual(names.light_depth("Key", 12), "shot.Key.depth.0012.exr")
        self.assertEqual(names.light_depth("Key/1 a", 12), "shot.Key_1_a.depth.0012.exr")
        lone = output_names.parse_output("d/one.exr", 1)
        self.assertEqual(lone.light_depth("Key", 12), "one.Key.depth.exr")
        self.assertEqual(lone.sidecar(12), "one.json")

    def test_patterns_that_cannot_work_are_refused(self):
        for pattern, frames in (("shot.exr", 2), ("shot.####.png", 1), ("#.####.exr", 1)):
            with self.subTest(pattern), self.assertRaises(errors.UsageError):
                output_names.parse_output(pattern, frames)

    def test_layer_names_fit_and_stay_distinct(self):
        lights = ["Key", "The key light beside the window, left",
                  "The key light beside the window, right", "Lämpchen über dem großen Tisch"]
        keys = output_names.light_keys(lights)
        self.assertEqual(keys["Key"], "Key")
        self.assertEqual(len(set(keys.values())), len(lights))
        for key in keys.values():
            for layer in (output_names.mask_layer(key, 63), output_names.truth_layer(key)):
                self.assertLessEqual(len(layer.encode()), output_names.LONGEST_LAYER)


class Named:
    def __init__(self, name, library=None):
        self.name, self.original = name, self
        self.name_full = f"{name} [{library}]" if library else name


class OtherKind(Named):
    pass


class UniqueNames(unittest.TestCase):
    def test_only_names_that_come_twice_carry_their_library(self):
        items = [Named("Body"), Named("Body", "cast.blend"), Named("Body", "crowd.blend"),
                 Named("Hat", "cast.blend")]
        names = exporter("unique_names").UniqueNames(items, [OtherKind("Hat")])
        self.assertEqual([names.of(item) for item in items],
                         ["Body", "Body [cast.blend]", "Body [crowd.blend]", "Hat"])


class Cryptomatte(unittest.TestCase):
    def test_known_hashes(self):
        # Reference values of MurmurHash3_x86_32.
        self.assertEqual(murmur3.murmur3_32(b""), 0)
        self.assertEqual(murmur3.murmur3_32(b"", 1), 0x514E28B7)
        self.assertEqual(murmur3.murmur3_32(b"aaaa", 0x9747B28C), 0x5A97808A)
        self.assertEqual(murmur3.murmur3_32(b"Hello, world!", 0x9747B28C), 0x24884CBA)

    def test_ids_that_blender_wrote(self):
        for name, text in (("Table", "25f2eeb0"), ("Vase", "04bb4c09"), ("Pear Stalk", "060c147d"),
                           ("Twigs", "68ce800b"), ("Teal Glaze", "7a24fe5d")):
            self.assertEqual(murmur3.cryptomatte_hex(name), text)

    def test_the_exponent_bit_is_flipped_where_the_hash_is_no_normal_float(self):
        self.assertEqual(murmur3.murmur3_32(b"Box"), 0x803B1009)
        self.assertEqual(murmur3.cryptomatte_hex("Box"), "80bb1009")

    def test_every_id_is_a_normal_float(self):
        for number in range(20000):
            value = int(murmur3.cryptomatte_hex(f"object {number}"), 16)
            self.assertNotIn(value >> 23 & 0xFF, (0, 255))


if __name__ == "__main__":
    unittest.main()
