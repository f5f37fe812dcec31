# SPDX-License-Identifier: GPL-3.0-or-later
"""Exports the check scene with the Blender that is installed, and looks at every pixel of it."""

import hashlib
import json
import math
import os
import shutil
import subprocess
import tempfile
import unittest

from exr_pixels import bits, read_exr
from paths import REPOSITORY, exporter

float_safe = exporter("murmur3").float_safe
BLENDER = shutil.which("blender")
HERE = os.path.dirname(os.path.abspath(__file__))
LIGHTS = ("Point.001 key", "Spot", "Sun", "Area")


def blender(*words):
    return subprocess.run([BLENDER, "-b", *words], capture_output=True, text=True, timeout=600)


def export(shot, *words):
    script = os.path.join(REPOSITORY, "blender_export", "export_aovs.py")
    return blender(shot, "--python-exit-code", "3", "-P", script, "--", *words)


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def multiply(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


@unittest.skipUnless(BLENDER, "Blender is not installed")
class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="kagefude-check-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.shot = os.path.join(cls.folder, "shot.blend")
        made = blender("--factory-startup", "--python-exit-code", "1", "-P",
                       os.path.join(HERE, "make_check_scene.py"), "--", cls.shot)
        assert made.returncode == 0, made.stdout + made.stderr
        cls.before = digest(cls.shot)
        cls.run_result = export(cls.shot, "--output", cls.path("out/shot.####.exr"), "--frames", "2",
                                "--masks", "disc:5", "--truth", "16", "--depth-size", "256")
        assert cls.run_result.returncode == 0, cls.run_result.stdout + cls.run_result.stderr
        pixels, cls.attributes = read_exr(cls.path("out/shot.0002.exr"))
        # Blender 4 and later write Cryptomatte's channels in lower case.
        cls.pixels = {name[:-1] + name[-1].upper(): rows for name, rows in pixels.items()}
        with open(cls.path("out/shot.0002.json"), encoding="utf-8") as file:
            cls.document = json.load(file)

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder, name)

    def channel(self, name):
        return [value for row in self.pixels[name] for value in row]

    def positions(self):
        return list(zip(*(self.channel(f"data.Position.{axis}") for axis in "XYZ")))

    def entry(self, kind, name):
        return next(item for item in self.document[kind] if item["name"] == name)

    def test_the_file_on_disk_is_as_it_was(self):
        self.assertEqual(digest(self.shot), self.before)
        self.assertEqual(sorted(os.listdir(self.folder)), ["out", "shot.blend"])

    def test_only_finished_files_are_there(self):
        names = {"shot.0002.exr", "shot.0002.json"}
        names |= {light["depth_map"]["file"] for light in self.document["lights"]}
        self.assertEqual(set(os.listdir(self.path("out"))), names)

    def test_progress_is_told_and_no_line_looks_like_an_error(self):
        said = self.run_result.stdout + self.run_result.stderr
        self.assertIn("Progress: 100%", said)
        self.assertIn("frame 2 (1 of 1)", said)
        self.assertNotIn("error", said.lower())

    def test_json_keeps_to_its_schema(self):
        with open(os.path.join(REPOSITORY, "blender_export", "frame.schema.json")) as file:
            schema = json.load(file)
        self.assertIsNone(exporter("schema_check").first_problem(self.document, schema))
        self.assertEqual([light["name"] for light in self.document["lights"]], sorted(LIGHTS))
        self.assertEqual(self.document["resolution"], [128, 128])

    def test_all_layers_are_there(self):
        wanted = {"data.Normal.X", "data.Position.Z", "data.Depth.V", "data.IndexOB.V",
                  "data.IndexMA.V", "data.Vector.X", "data.UV.X", "data.DiffCol.R",
                  "data.CryptoObject00.R", "data.CryptoMaterial00.R", "beauty.Combined.R",
                  "data.MeanNormal.X", "data.Emit.R"}
        for light in self.document["lights"]:
            wanted |= {sample["layer"] + ".V" for sample in light["masks"]["samples"]}
            wanted.add(light["truth_layer"] + ".V")
            self.assertEqual(len(light["masks"]["samples"]), 5)
        self.assertEqual(wanted - set(self.pixels), set())

    def test_what_shines_without_the_lights_is_told(self):
        for found, wanted in zip(self.document["world"]["radiance"], (0.25, 0.3, 0.4)):
            self.assertAlmostEqual(found, wanted, places=6)
        glow = {tuple(round(value, 4) for value in colour)
                for colour in zip(*(self.channel(f"data.Emit.{part}") for part in "RGB"))}
        self.assertEqual(glow, {(0.0, 0.0, 0.0), (1.0, 0.5, 0.2)}, "the box alone glows")

    def test_masks_are_exactly_0_or_1_and_show_both(self):
        for light in self.document["lights"]:
            for sample in light["masks"]["samples"]:
                self.assertEqual(set(self.channel(sample["layer"] + ".V")), {0.0, 1.0})

    def test_truth_is_a_share_and_agrees_with_masks_that_agree(self):
        for light in self.document["lights"]:
            truth = self.channel(light["truth_layer"] + ".V")
            self.assertTrue(all(0.0 <= value <= 1.0 + 1e-6 for value in truth))
            masks = [self.channel(sample["layer"] + ".V") for sample in light["masks"]["samples"]]
            for value in (0.0, 1.0):
                same = [t for t, *m in zip(truth, *masks) if set(m) == {value}]
                wrong = sum(abs(t - value) for t in same) / len(same)
                self.assertLess(wrong, 0.03, (light["name"], value))
            soft = sum(0.05 < value < 0.95 for value in truth)
            self.assertGreater(soft, 100, light["name"])

    def test_surfaces_that_face_away_are_hidden(self):
        normals = list(zip(*(self.channel(f"data.Normal.{axis}") for axis in "XYZ")))
        for light in self.document["lights"]:
            sample = light["masks"]["samples"][0]
            mask = self.channel(sample["layer"] + ".V")
            for place, normal, value in zip(self.positions(), normals, mask):
                to_light = [-a for a in sample["direction"]] if light["type"] == "sun" else \
                    [a - b for a, b in zip(sample["position"], place)]
                size = math.sqrt(sum(a * a for a in to_light))
                if sum(a * b for a, b in zip(normal, to_light)) < -0.02 * size:
                    self.assertEqual(value, 0.0)

    def test_data_is_sampled_at_pixel_centres_without_depth_of_field(self):
        lengths = [math.sqrt(sum(a * a for a in normal)) for normal in
                   zip(*(self.channel(f"data.Normal.{axis}") for axis in "XYZ"))]
        self.assertTrue(all(abs(size - 1.0) < 1e-3 or size == 0.0 for size in lengths))
        camera = self.document["camera"]
        for number, place in enumerate(self.positions()):
            if self.channel_ids[number] == 0:
                continue
            eye = multiply(camera["camera_from_world"], (*place, 1.0))
            clip = multiply(camera["clip_from_camera"], eye)
            column = (clip[0] / clip[3] * 0.5 + 0.5) * 128
            row = (0.5 - clip[1] / clip[3] * 0.5) * 128
            self.assertAlmostEqual(column, number % 128 + 0.5, delta=0.03)
            self.assertAlmostEqual(row, number // 128 + 0.5, delta=0.03)
            self.assertAlmostEqual(-eye[2], self.pixels["data.Depth.V"][number // 128][number % 128],
                                   delta=1e-3)

    @property
    def channel_ids(self):
        return self.channel("data.IndexOB.V")

    def test_indices_are_distinct_and_the_artists_own_is_kept(self):
        indices = [item["index"] for item in self.document["objects"]]
        self.assertEqual(len(set(indices)), len(indices))
        self.assertEqual(self.entry("objects", "Box")["index"], 7)
        self.assertEqual(set(self.channel_ids) - {0.0}, {float(index) for index in indices})
        self.assertEqual({item["name"] for item in self.document["objects"]}, {"Ground", "Ball", "Box"})

    def test_cryptomatte_agrees_with_the_json(self):
        manifests = {self.attributes[key.replace("/manifest", "/name")].decode():
                     json.loads(value) for key, value in self.attributes.items()
                     if key.startswith("cryptomatte/") and key.endswith("/manifest")}
        for kind, layer in (("objects", "data.CryptoObject"), ("materials", "data.CryptoMaterial")):
            for item in self.document[kind]:
                if item["name"] in manifests[layer]:
                    value = int(manifests[layer][item["name"]], 16)
                    self.assertEqual(f"{float_safe(value):08x}", item["crypto"])
        found = {bits(value) for value in self.channel("data.CryptoObject00.R")}
        for item in self.document["objects"]:
            self.assertIn(int(item["crypto"], 16), found)

    def test_mean_normals_are_those_of_all_samples(self):
        own, mean = (list(zip(*(self.channel(f"data.{name}.{axis}") for axis in "XYZ")))
                     for name in ("Normal", "MeanNormal"))
        lengths = [math.hypot(*normal) for normal in mean]
        self.assertLess(max(lengths), 1.001)
        mixed = sum(0.1 < length < 0.95 for length in lengths)
        self.assertGreater(mixed, 50, "edges are mixtures")
        same = sum(math.dist(a, b) < 0.1 for a, b in zip(own, mean))
        self.assertGreater(same, 0.7 * len(own), "away from them one surface fills the pixel")

    def test_bounds_and_reference_points(self):
        ball = self.entry("objects", "Ball")
        self.assertEqual(len(ball["reference_points"]), 1)
        for found, wanted in zip(ball["reference_point"], (-1.2, 0.0, 1.6)):
            self.assertAlmostEqual(found, wanted, 4)
        box = self.entry("objects", "Box")
        for found, wanted in zip(box["reference_point"], (1.6, 0.4, 0.6)):
            self.assertAlmostEqual(found, wanted, 4)
        self.assertTrue(self.entry("objects", "Ground")["flat"])
        self.assertFalse(ball["flat"] or box["flat"])

    def test_motion_vectors_follow_the_moving_object_only(self):
        ball = self.entry("objects", "Ball")["index"]
        for index, motion in zip(self.channel_ids, self.channel("data.Vector.X")):
            self.assertEqual(abs(motion) > 0.5, index == ball)

    def test_masks_lie_on_the_light(self):
        for light in self.document["lights"]:
            u, v = light["axes"]["u"], light["axes"]["v"]
            offset = light["masks"]["offset"]
            offset_v = light["masks"].get("offset_v", offset)
            flat = light["type"] == "area"
            self.assertEqual(light["masks"]["arrangement"], "grid" if flat else "disc")
            for found, wanted in zip((offset, offset_v),
                                     (0.75, 0.15) if flat else [light["radius"]] * 2):
                self.assertAlmostEqual(found, wanted, 5)
            if light["type"] == "sun":
                continue
            for sample in light["masks"]["samples"]:
                wanted = [p + offset * sample["uv"][0] * a + offset_v * sample["uv"][1] * b
                          for p, a, b in zip(light["position"], u, v)]
                for a, b in zip(sample["position"], wanted):
                    self.assertAlmostEqual(a, b, 5)
        area = self.entry("lights", "Area")
        self.assertEqual({tuple(sample["uv"]) for sample in area["masks"]["samples"][1:]},
                         {(-1, -1), (1, -1), (-1, 1), (1, 1)})
        self.assertAlmostEqual(area["radius"], math.sqrt(1.5 * 0.3 / math.pi), 5)
        self.assertAlmostEqual(self.entry("lights", "Sun")["radius"], math.tan(math.radians(3)), 6)

    def test_depth_maps_agree_with_positions_and_masks(self):
        """A pixel that the light's centre sees is where the map says that the nearest surface is."""
        for light in self.document["lights"]:
            depth_map = light["depth_map"]
            channels, _ = read_exr(self.path("out/" + depth_map["file"]))
            size = depth_map["resolution"][0]
            depths = channels[depth_map["channel"]]
            mask = self.channel(light["masks"]["samples"][0]["layer"] + ".V")
            agree = total = 0
            for place, seen, index in zip(self.positions(), mask, self.channel_ids):
                eye = multiply(depth_map["light_from_world"], (*place, 1.0))
                clip = multiply(depth_map["clip_from_light"], eye)
                x, y = clip[0] / clip[3], clip[1] / clip[3]
                if index == 0 or not (abs(x) < 0.99 and abs(y) < 0.99):
                    continue
                column, row = int((x * 0.5 + 0.5) * size), int((0.5 - y * 0.5) * size)
                lit = -eye[2] <= depths[row][column] + 0.08
                total += 1
                agree += lit == (seen == 1.0)
            self.assertGreater(total, 3000, light["name"])
            self.assertGreater(agree / total, 0.95, light["name"])

    def test_requests_that_cannot_be_met_end_with_one_clear_sentence(self):
        for words, status, sentence in (
                (("--light", "Spott"), 3, "did you mean 'Spot'"),
                (("--masks", "pair", "--light", "Sun"), 3, "light 'Sun' is a sun"),
                (("--frames", "1-3"), 2, "no #### for the frame number"),
                (("--masks", "disk:9"), 2, "did you mean 'disc:9'"),
                (("--colour", "red"), 2, "unrecognized arguments: --colour red")):
            with self.subTest(words):
                result = export(self.shot, "--output", self.path("bad/shot.exr"), *words)
                self.assertEqual(result.returncode, status, result.stdout + result.stderr)
                errors = [line for line in result.stderr.splitlines() if line.startswith("Error:")]
                self.assertEqual(len(errors), 1, result.stderr)
                self.assertIn(sentence, errors[0])
                self.assertFalse(os.path.exists(self.path("bad")))

    def test_blender_4_without_a_shadow_pass_gives_the_same_masks(self):
        program = ("import sys; sys.path.insert(0, sys.argv[-2]); "
                   "from blender_export import compat, export_aovs; "
                   "compat.has_shadow_pass = lambda: False; "
                   "sys.exit(export_aovs.main(['--output', sys.argv[-1], '--masks', 'disc:5', "
                   "'--depth-size', '16']))")
        folder = tempfile.mkdtemp(prefix="kagefude-four-")
        self.addCleanup(shutil.rmtree, folder)
        path = os.path.join(folder, "shot.exr")
        result = blender(self.shot, "--python-expr", program, "--", REPOSITORY, path)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        channels, _ = read_exr(path)
        masks = [name for name in channels if name.startswith("mask.")]
        self.assertEqual(len(masks), 20)
        for name in masks:
            self.assertEqual(channels[name], self.pixels[name], name)

    def test_denoising_that_this_blender_may_lack_does_not_stop_the_export(self):
        shot = self.path("denoised.blend")
        self.addCleanup(os.remove, shot)
        made = blender(self.shot, "--python-expr",
                       "import bpy; bpy.context.scene.cycles.use_denoising = True; "
                       f"bpy.ops.wm.save_as_mainfile(filepath={shot!r}, copy=True)")
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        folder = tempfile.mkdtemp(prefix="kagefude-denoise-")
        self.addCleanup(shutil.rmtree, folder)
        result = export(shot, "--output", os.path.join(folder, "a.exr"), "--light", "Spot",
                        "--masks", "pair", "--depth-size", "16")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_objects_that_appear_later_are_described_once_they_render(self):
        folder = tempfile.mkdtemp(prefix="kagefude-late-")
        self.addCleanup(shutil.rmtree, folder)
        result = export(self.shot, "--output", os.path.join(folder, "a.##.exr"), "--frames", "2-3",
                        "--masks", "pair", "--light", "Spot", "--depth-size", "16")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        for frame, there in ((2, False), (3, True)):
            with open(os.path.join(folder, f"a.{frame:02}.json"), encoding="utf-8") as file:
                objects = {item["name"]: item["index"] for item in json.load(file)["objects"]}
            self.assertEqual("Late" in objects, there)
            channels, _ = read_exr(os.path.join(folder, f"a.{frame:02}.exr"))
            seen = {value for row in channels["data.IndexOB.V"] for value in row} - {0.0}
            self.assertEqual(seen, {float(index) for index in objects.values()})

    def test_scale_and_line(self):
        folder = tempfile.mkdtemp(prefix="kagefude-scale-")
        self.addCleanup(shutil.rmtree, folder)
        result = export(self.shot, "--output", os.path.join(folder, "a.####.exr"), "--scale", "2",
                        "--masks", "line:3", "--light", "Area", "--depth-size", "32")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        with open(os.path.join(folder, "a.0002.json"), encoding="utf-8") as file:
            document = json.load(file)
        self.assertEqual((document["resolution"], document["scale"]), ([256, 256], 2))
        area = document["lights"][0]
        self.assertAlmostEqual(area["masks"]["offset"], 0.75, 5)
        self.assertAlmostEqual(abs(area["axes"]["u"][0]), 1.0, 5)
        channels, _ = read_exr(os.path.join(folder, "a.0002.exr"))
        self.assertEqual(len(channels["data.Depth.V"]), 256)

    def test_add_on_exports_a_copy_and_leaves_the_open_file_alone(self):
        folder = tempfile.mkdtemp(prefix="kagefude-addon-")
        self.addCleanup(shutil.rmtree, folder)
        result = blender(self.shot, "--python-exit-code", "1", "-P",
                         os.path.join(HERE, "check_addon.py"), "--",
                         os.path.join(folder, "shot.####.exr"))
        self.assertIn("add-on checked", result.stdout, result.stdout + result.stderr)
        self.assertTrue(os.path.exists(os.path.join(folder, "shot.0002.json")))


if __name__ == "__main__":
    unittest.main()
