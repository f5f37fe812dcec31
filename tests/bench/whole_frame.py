"""The whole frame against copying it: gates of time, memory, size and threads, in one run.

    python3 tests/bench/whole_frame.py KAGEFUDE [--json FILE]

The peer is oiiotool, reading the same 20 channels and writing the same outputs with no work in
between. The two take turns; medians are compared. Exit 1 when a gate is missed.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROUNDS = 5
LAYERS = ["visibility.Key", "brush.tone"]
COPY = ("R=beauty.Combined.R,G=beauty.Combined.G,B=beauty.Combined.B,A=beauty.Combined.A,"
        "visibility.Key=mask.Key.0.V,brush.tone=data.Position.Z")


def run(command):
    """Seconds on the wall and the largest resident memory in bytes. Ours waits until its output is on
    the disk; what others have left to be written must not be part of that."""
    os.sync()
    start = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    if status:
        sys.exit(f"{command[0]} failed: {' '.join(map(str, command))}")
    return time.perf_counter() - start, usage.ru_maxrss * 1024


def bench(kagefude, *options):
    done = subprocess.run([kagefude, "bench", "--json", *options], check=True, capture_output=True)
    return json.loads(done.stdout)


def computing(report):
    return sum(s["seconds"] for s in report["stages"] if s["stage"] not in ("read", "write"))


class Gates:
    def __init__(self):
        self.rows, self.missed = [], 0

    def add(self, name, value, gate, kept, unit="x"):
        self.rows.append({"name": name, "value": value, "gate": gate, "kept": kept})
        self.missed += not kept
        print(f"| {name} | {value:.2f}{unit} | {gate} | {'kept' if kept else 'MISSED'} |", flush=True)


def against_copy(kagefude, folder, gates):
    frame, look = folder / "frame.exr", folder / "look.toml"
    look.write_text(f"[output]\nlayers = {json.dumps(LAYERS)}\n")
    subprocess.run([kagefude, "bench", "--save", frame], check=True)
    ours = [kagefude, "comp", look, frame, "-o", folder / "ours.exr", "--progress", "none"]
    theirs = ["oiiotool", frame, "--ch", COPY, "-d", "half"]
    for layer in LAYERS:
        theirs += ["-d", f"{layer}=float"]
    theirs += ["--compression", "zip", "-o", folder / "theirs.exr"]
    times, peaks = {0: [], 1: []}, []
    for round_number in range(ROUNDS + 1):
        for which, command in enumerate((ours, theirs)):
            seconds, peak = run(command)
            if round_number:
                times[which].append(seconds)
            if which == 0:
                peaks.append(peak)
    ratio = statistics.median(times[0]) / statistics.median(times[1])
    gates.add("comp of a 4K frame with nine masks, times oiiotool's copy", ratio, "<= 0.4x",
              ratio <= 0.4)
    peak = max(peaks) / 1e9
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
    print("| what | measured | gate | |\n|---|---|---|---|")
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
