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
    "pair_in_object": "pair search within the object", "pcss": "PCSS from the depth map",
    "average": "average of the nine masks", "five_masks": "**five masks**",
    "nine_linear": "nine masks, one linear fit", "nine_wedges": "nine masks, wedges alone",
    "nine_masks": "**nine masks**"}


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


def side_by_side(folder, scene):
    """Truth, then the methods, with their errors below."""
    truth = f"{folder}/{scene}/disc9/{scene}.0001.exr"
    shown = ["pcss", "average", "five_masks", "nine_masks"]
    command = ["oiiotool", truth, "--ch", "truth.Key.V,truth.Key.V,truth.Key.V", "--chnames", "R,G,B"]
    for method in shown:
        channel = "Y" if method == "average" else "visibility.Key"
        command += [f"{folder}/{scene}/{method}/{scene}.0001.exr", "--ch",
                    f"{channel},{channel},{channel}", "--chnames", "R,G,B"]
    command += [truth, "--ch", "truth.Key.V,truth.Key.V,truth.Key.V", "--chnames", "R,G,B",
                "--mulc", "0", "--addc", "0.5"]
    command += [f"{folder}/{scene}/{method}/{scene}.0001.error.png" for method in shown]
    command += ["--mosaic:pad=4", f"{len(shown) + 1}x2", "-d", "uint8",
                "-o", f"{folder}/{scene}/side_by_side.png"]
    subprocess.run(command, check=True)


def main():
    folder, scenes = sys.argv[1], sys.argv[2:]
    print(table(folder, scenes))
    for scene in scenes:
        side_by_side(folder, scene)
    if "moving" in scenes:
        print("\nChange of the error from frame to frame in `moving`, RMS over the penumbra "
              "(mean, worst of 11):")
        for method in ("pcss", "average", "five_masks", "nine_masks"):
            mean, worst = change(folder, "moving", method,
                                 os.environ.get("KAGEFUDE", "build/release/kagefude"))
            print(f"- {METHODS[method].strip('*')}: {mean:.3f}, {worst:.3f}")


main()
