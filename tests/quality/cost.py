# SPDX-License-Identifier: Apache-2.0
"""Measures what cost.sh says, in CPU seconds (user and system), which other work disturbs least."""

import argparse
import itertools
import json
import math
import os
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass

BLENDER = shlex.split(os.environ.get("BLENDER", "blender"))
KAGEFUDE = os.path.abspath(os.environ.get("KAGEFUDE", "build/release/kagefude"))
HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(ROOT, "tests", "bench"))

from timed import timed  # noqa: E402  (after the path)


@dataclass
class Cost:
    seconds: float
    megabytes: float


def least(runs, measure_once, *words):
    """The least of some runs: other work only adds, to kernel time most."""
    took = [measure_once(*words) for _ in range(runs)]
    return Cost(min(each.cpu for each in took), min(each.peak for each in took) / 2**20)


def blender(*words):
    return timed([*BLENDER, "-b", *words])


def make_scene(scene, path):
    blender("--factory-startup", "--python-exit-code", "3", "-P", os.path.join(HERE, "scenes.py"),
            "--", scene, path)


def export(shot, folder, *words, frames="1"):
    script = os.path.join(ROOT, "blender_export", "export_aovs.py")
    return blender(shot, "--python-exit-code", "3", "-P", script, "--", "--output",
                   os.path.abspath(f"{folder}/s.####.exr"), "--frames", frames, *words)


def plain(shot, samples, frames="1"):
    """Cycles' own picture of the shot with so many samples, and nothing else."""
    program = ("import bpy; scene = bpy.context.scene; scene.cycles.use_adaptive_sampling = False; "
               f"scene.cycles.samples = {samples}")
    return blender(shot, "--python-expr", program, "-o", os.path.abspath("plain.####"), "-f", frames)


def comp(look, folder, *words, frames="1"):
    return timed([KAGEFUDE, "comp", look, f"{folder}/s.####.exr", "-o", f"{folder}/comp.####.exr",
                  "--frames", frames, "--progress", "none", *words])


def blender_version():
    said = subprocess.run([*BLENDER, "--version"], capture_output=True, text=True, check=True).stdout
    return re.search(r"Blender (\d+\.\d+)", said)[1]


def penumbra_rmse(image, channel, truth, samples):
    said = subprocess.run([KAGEFUDE, "compare", image, truth, "--channel", channel, "--against",
                           "truth.Key", "--where", "data.IndexOB", "--truth-samples", str(samples),
                           "--json"], check=True, capture_output=True, text=True).stdout
    return json.loads(said)["penumbra"]["rmse"]


def cost_at(rmse, traced):
    """Seconds and samples that tracing takes for an error, between the measured ones.

    `traced` are (samples, rmse, cost) by samples; log RMSE is linear in log samples, and seconds
    are linear in samples. Beyond them the nearest two go on.
    """
    pairs = list(zip(traced, traced[1:]))
    before, after = next((pair for pair in pairs if pair[1][1] <= rmse), pairs[-1])
    slope = math.log(after[0] / before[0]) / math.log(after[1] / before[1])
    samples = before[0] * (rmse / before[1]) ** slope
    share = (samples - before[0]) / (after[0] - before[0])
    return before[2].seconds + share * (after[2].seconds - before[2].seconds), samples


def measure(scene, options, version):
    os.makedirs(scene, exist_ok=True)
    shot = os.path.abspath(f"{scene}/{scene}.blend")
    make_scene(scene, shot)
    truth = f"{scene}/truth/s.0001.exr"
    if not os.path.exists(truth):
        export(shot, f"{scene}/truth", "--masks", "disc:5", "--truth", str(options.truth))
    one = least(options.runs, plain, shot, 1)
    rows = [f"| {version} | {scene} | one sample, plain | {one.seconds:.1f} | 1.0 | | "
            f"{one.megabytes:.0f} MB | |"]
    # A Shadow pass (until 3.4) and masks take light from below a surface's horizon as hidden; the
    # traced shadows of later Blenders leave it out. So each is held against its own kind of truth.
    masks_truth = f"{options.masks_against}/{scene}/truth/s.0001.exr" if options.masks_against else truth
    traced = []
    for samples in options.samples:
        export(shot, f"{scene}/trace", "--masks", f"trace:{samples}")
        rmse = penumbra_rmse(f"{scene}/trace/s.0001.exr", "traced.Key", truth, options.truth)
        cost = least(options.runs, plain, shot, samples)
        traced.append((samples, rmse, cost))
        rows.append(f"| {version} | {scene} | Cycles, {samples} samples | {cost.seconds:.1f} | "
                    f"{cost.seconds / one.seconds:.1f} | {rmse:.4f} | {cost.megabytes:.0f} MB | |")
    for masks, by in itertools.product(options.masks, options.by):
        folder = f"{scene}/{by}"
        cost = least(options.runs, export, shot, folder, "--masks", masks, "--masks-by", by)
        with open(f"{folder}/s.0001.json", encoding="utf-8") as file:
            way = json.load(file)["lights"][0]["masks"]["by"]
        comped = comp(os.path.join(HERE, "measure.toml"), folder).cpu
        rmse = penumbra_rmse(f"{folder}/comp.0001.exr", "visibility.Key", masks_truth, options.truth)
        peer, samples = cost_at(rmse, traced)
        total = cost.seconds + comped
        rows.append(f"| {version} | {scene} | {masks} by {way}, and comp | {cost.seconds:.1f} + "
                    f"{comped:.1f} | {cost.seconds / one.seconds:.1f} | {rmse:.4f} | "
                    f"{cost.megabytes:.0f} MB | {total / peer:.2f} of tracing's {peer:.1f} "
                    f"({samples:.0f} samples) |")
    return rows


def main():
    numbers = lambda text: [int(word) for word in text.split(",")]  # noqa: E731
    parser = argparse.ArgumentParser(prog="cost.sh", allow_abbrev=False)
    parser.add_argument("--scenes", default=["ball_and_box", "heads"], type=lambda t: t.split(","))
    parser.add_argument("--samples", default=[16, 64, 256], type=numbers)
    parser.add_argument("--truth", default=512, type=int)
    parser.add_argument("--by", default=["auto", "layers", "groups"], type=lambda t: t.split(","))
    parser.add_argument("--masks", default=["pair", "disc:5", "disc:9", "disc:17"],
                        type=lambda t: t.split(","))
    parser.add_argument("--runs", default=2, type=int)
    parser.add_argument("--masks-against", type=os.path.abspath)
    options = parser.parse_args()
    if len(options.samples) < 2:
        parser.error("--samples wants two or more, to tell the cost of an error between them")
    version = blender_version()
    folder = os.path.join(ROOT, "build", "cost", version)
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    print("| Blender | scene | what | CPU s | of one sample | penumbra RMSE | peak | at equal RMSE |")
    print("|---|---|---|---|---|---|---|---|")
    for scene in options.scenes:
        for row in measure(scene, options, version):
            print(row, flush=True)


if __name__ == "__main__":
    main()
