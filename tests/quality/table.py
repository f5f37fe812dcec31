# SPDX-License-Identifier: Apache-2.0
"""Prints the quality table as Markdown from what run.sh measured, and makes the pictures.

table.py FOLDER SCENE ...
"""

import glob
import json
import os
import statistics
import subprocess
import sys

METHODS = {
    "hard": "hard mask of the centre", "seed_pair": "seed's pair search",
    "pair_in_object": "pair, not smoothed", "pair_smooth": "pair",
    "pair_depth": "**pair with the depth map**",
    "pcss": "PCSS from the depth map",
    "average": "average of the nine masks", "five_alone": "five masks alone",
    "five_masks": "**five masks**",
    "nine_linear": "nine masks, one linear fit", "nine_wedges": "nine masks, wedges alone",
    "nine_alone": "nine masks alone",
    "nine_masks": "**nine masks**", "seventeen_masks": "seventeen masks",
    "thirty_three_masks": "thirty-three masks"}
# What the pictures show, in this order, and what stands over them.
SHOWN = {"hard": "hard mask", "seed_pair": "seed's pair", "pair_smooth": "pair", "pcss": "PCSS",
         "average": "mean of 9", "five_masks": "five masks", "nine_masks": "nine masks",
         "seventeen_masks": "17 masks"}

FONTS = ["/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
         "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"]


def frames(folder, scene, method):
    """One comparison a frame, in frame order."""
    found = sorted(glob.glob(f"{folder}/{scene}/{method}/{scene}.????.json"))
    return [json.load(open(name, encoding="utf-8")) for name in found]


def mean_rmse(results):
    return statistics.fmean(result["penumbra"]["rmse"] for result in results)


def table(folder, scenes):
    words = [scene.replace("_", " ") for scene in scenes]
    lines = ["| penumbra RMSE | " + " | ".join(words) + " | median |",
             "|---|" + "---|" * (len(scenes) + 1)]
    for method, title in METHODS.items():
        values = [mean_rmse(frames(folder, scene, method)) for scene in scenes]
        cells = [f"{value:.3f}" for value in values + [statistics.median(values)]]
        lines.append(f"| {title} | " + " | ".join(cells) + " |")
    noise = [frames(folder, scene, "nine_masks")[0]["penumbra"]["truth_noise"] for scene in scenes]
    lines.append("| noise of the truth, at most | " + " | ".join(f"{n:.3f}" for n in noise) + " | |")
    return "\n".join(lines)


def error_image(folder, scene, method, frame, out):
    """An EXR of error Y and penumbra marker P, not 0 where truth is in (0.02, 0.98)."""
    truth = f"{folder}/{scene}/disc9/{scene}.{frame}.exr"
    channel = "Y" if method == "average" else "visibility.Key"
    subprocess.run(["oiiotool", truth, "--ch", "truth.Key.V", "--chnames", "Y", "--label", "T",
                    f"{folder}/{scene}/{method}/{scene}.{frame}.exr", "--ch", channel,
                    "--chnames", "Y", "T", "--sub", "T", "--mulc", "-1", "--addc", "1", "T",
                    "--mul", "--subc", "0.0196", "--maxc", "0", "--chnames", "P", "--chappend",
                    "-d", "float", "-o", out], check=True)


def change(folder, scene, method, kagefude):
    """RMS over the penumbra of the error's change from frame to frame: mean and worst frame."""
    numbers = [os.path.basename(name).split(".")[1]
               for name in sorted(glob.glob(f"{folder}/{scene}/{method}/{scene}.????.exr"))]
    images = [f"{folder}/{scene}/{method}/error.{number}.exr" for number in numbers]
    for number, image in zip(numbers, images):
        error_image(folder, scene, method, number, image)
    changes = []
    for before, after in zip(images, images[1:]):
        said = subprocess.run([kagefude, "compare", after, before, "--channel", "Y", "--where", "P",
                               "--json"], check=True, capture_output=True, text=True).stdout
        changes.append(json.loads(said)["rmse"])
    return statistics.fmean(changes), max(changes)


def grey(folder, scene, method):
    """oiiotool's words for a method's visibility as an RGB picture; truth is a method here."""
    if method == "truth":
        return [f"{folder}/{scene}/disc9/{scene}.0001.exr", "--ch",
                ",".join(["truth.Key.V"] * 3), "--chnames", "R,G,B"]
    channel = "Y" if method == "average" else "visibility.Key"
    return [f"{folder}/{scene}/{method}/{scene}.0001.exr", "--ch", ",".join([channel] * 3),
            "--chnames", "R,G,B"]


def label(words, size):
    """oiiotool's words to write over a picture; nothing where the machine has no such font."""
    for font in FONTS:
        if os.path.exists(font):
            return [f"--text:x=6:y={size + 4}:size={size}:color=0.8,0.1,0.1:font={font}", words]
    return []


def side_by_side(folder, scene):
    """Truth and every method, with their errors below (grey is right, white too light)."""
    command = ["oiiotool", *grey(folder, scene, "truth"), *label("truth", 20)]
    for method, words in SHOWN.items():
        command += [*grey(folder, scene, method), *label(words, 20)]
    command += [*grey(folder, scene, "truth"), "--mulc", "0", "--addc", "0.5",
                *label("error x 2", 20)]
    for method in SHOWN:
        value = frames(folder, scene, method)[0]["penumbra"]["rmse"]
        command += [f"{folder}/{scene}/{method}/{scene}.0001.error.png", *label(f"{value:.3f}", 20)]
    command += ["--mosaic:pad=4", f"{len(SHOWN) + 1}x2", "-d", "uint8",
                "-o", f"{folder}/{scene}/side_by_side.png"]
    subprocess.run(command, check=True)


def montage(folder, scenes):
    """One small picture of all scenes: a row each, truth, methods, and the error of nine masks."""
    columns = ["truth", "hard", "seed_pair", "pair_smooth", "pcss", "average", "nine_masks"]
    side = 120
    command = ["oiiotool"]
    for row, scene in enumerate(scenes):
        for method in columns:
            command += [*grey(folder, scene, method), "--resize", f"{side}x{side}"]
            words = SHOWN.get(method, method) if row == 0 else ""
            command += label(words or (scene.replace("_", " ") if method == "truth" else " "), 13)
        command += [f"{folder}/{scene}/nine_masks/{scene}.0001.error.png", "--resize",
                    f"{side}x{side}", *label("its error x 2" if row == 0 else " ", 13)]
    command += ["--mosaic:pad=2", f"{len(columns) + 1}x{len(scenes)}", "--ch", "R,G,B", "-d",
                "uint8", "-o", f"{folder}/side_by_side.png"]
    subprocess.run(command, check=True)


def main():
    folder, scenes = sys.argv[1], sys.argv[2:]
    print(table(folder, scenes))
    for scene in scenes:
        side_by_side(folder, scene)
    montage(folder, scenes)
    if "moving" in scenes:
        print("\nChange of the error from frame to frame in `moving`, RMS over the penumbra "
              "(mean, worst of 11):")
        for method in ("pcss", "average", "five_masks", "nine_masks"):
            mean, worst = change(folder, "moving", method,
                                 os.environ.get("KAGEFUDE", "build/release/kagefude"))
            print(f"- {METHODS[method].strip('*')}: {mean:.3f}, {worst:.3f}")
    print(f"\nPictures of every method beside the truth: {folder}/*/side_by_side.png, and all scenes "
          f"in {folder}/side_by_side.png")


main()
