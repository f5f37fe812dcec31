"""The whole frame against copying it: gates of time, memory, size and threads, in one run.

    python3 tests/bench/whole_frame.py KAGEFUDE [--json FILE]

The peer is oiiotool, reading the same 20 channels and writing the same outputs with no work in
between. The two take turns; medians are compared, and wall, user and system time told apart. Exit 1
when a gate is missed.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from timed import Gates, timed

ROUNDS = 5
LAYERS = ["visibility.Key", "brush.tone"]
COPY = ("R=beauty.Combined.R,G=beauty.Combined.G,B=beauty.Combined.B,A=beauty.Combined.A,"
        "visibility.Key=mask.Key.0.V,brush.tone=data.Position.Z")


def run(command):
    """Ours waits until its output is on the disk; what others have left to be written must not be
    part of that."""
    os.sync()
    return timed(command)


def median(took, name):
    return statistics.median(getattr(each, name) for each in took)


def make_bench_frame(kagefude, folder, *options):
    """frame.exr with its JSON, and the look."""
    (folder / "look.toml").write_text(f"[output]\nlayers = {json.dumps(LAYERS)}\n")
    subprocess.run([kagefude, "bench", "--save", folder / "frame.exr", *options], check=True)


def copy_words(target):
    """What oiiotool does after it has read: as many channels of the same types, packed alike."""
    words = ["--ch", COPY, "-d", "half"]
    for layer in LAYERS:
        words += ["-d", f"{layer}=float"]
    return [*words, "--compression", "zip", "-o", target]


def bench(kagefude, *options):
    done = subprocess.run([kagefude, "bench", "--json", *options], check=True, capture_output=True)
    return json.loads(done.stdout)


def computing(report):
    return sum(s["seconds"] for s in report["stages"] if s["stage"] not in ("read", "write"))


def against_copy(kagefude, folder, gates):
    make_bench_frame(kagefude, folder)
    frame = folder / "frame.exr"
    commands = {"kagefude": [kagefude, "comp", folder / "look.toml", frame, "-o", folder / "ours.exr",
                             "--progress", "none"],
                "oiiotool": ["oiiotool", frame, *copy_words(folder / "theirs.exr")]}
    took = {name: [] for name in commands}
    for round_number in range(ROUNDS + 1):
        for name, command in commands.items():
            once = run(command)
            if round_number:  # the first warms up
                took[name].append(once)
    ratio = median(took["kagefude"], "wall") / median(took["oiiotool"], "wall")
    gates.add("comp of a 4K frame with nine masks, times oiiotool's copy", ratio, "<= 0.4x",
              ratio <= 0.4)
    for name, each in took.items():
        gates.note(f"{name}: seconds on the wall, user, system",
                   ", ".join(f"{median(each, kind):.2f}" for kind in ("wall", "user", "system")))
    peak = max(once.peak for once in took["kagefude"]) / 1e9
    gates.add("its peak memory", peak, "< 1.5 GB", peak < 1.5, " GB")


def by_size(kagefude, gates):
    """Cost a pixel of larger frames beside that of 4K."""
    per_pixel = {}
    for size in ("3840x2160", "7680x4320", "5000x3400"):
        report = bench(kagefude, "--size", size, "--rounds", "3")
        per_pixel[size] = report["seconds"] / (report["width"] * report["height"])
    for size in ("7680x4320", "5000x3400"):
        ratio = per_pixel[size] / per_pixel["3840x2160"]
        gates.add(f"cost a pixel at {size}, times that at 4K", ratio, "<= 1.3x", ratio <= 1.3)


def by_threads(kagefude, gates):
    one, two = [], []
    for _ in range(3):
        one.append(computing(bench(kagefude, "--threads", "1", "--rounds", "3")))
        two.append(computing(bench(kagefude, "--threads", "2", "--rounds", "3")))
    ratio = statistics.median(one) / statistics.median(two)
    gates.add("passes with two threads, times faster than with one", ratio, ">= 1.7x", ratio >= 1.7)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kagefude", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path)
    arguments = parser.parse_args()
    gates = Gates()
    with tempfile.TemporaryDirectory() as folder:
        against_copy(arguments.kagefude, pathlib.Path(folder), gates)
    by_size(arguments.kagefude, gates)
    if os.cpu_count() > 1:
        by_threads(arguments.kagefude, gates)
    if arguments.json:
        arguments.json.write_text(json.dumps(gates.rows, indent=1))
    return 1 if gates.missed else 0


if __name__ == "__main__":
    sys.exit(main())
