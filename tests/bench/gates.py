"""Prints the ratios of a benchmark run and whether each keeps its gate; exit 1 when one does not.

    python3 tests/bench/gates.py BENCH.json
"""

import json
import os
import sys

# What is compared, our benchmark, the peer's, and the gate: the least factor by which we are
# faster, or the most times the peer's time that we may take.
FASTER = [
    ("brush, seed's mapping (two lookups), 21 styles, 4K", "brushSeed/process_time/real_time",
     "OpenCV phase and two remaps", "openCvPhaseTwoRemaps/process_time/real_time", 1.5),
    ("pair search, 1024x1024", "pairExact/1024/real_time", "naive search",
     "pairNaive/iterations:1", 20),
]
AT_MOST = [
    ("nine masks, distances and integral, 4K", "lightShapeNineMasks/0/repeats:5/real_time",
     "OpenCV distance transform", "openCvDistanceTransform/repeats:5/real_time", 10),
    ("nine masks with thin shadows followed, 4K", "lightShapeNineMasks/1/repeats:5/real_time",
     "OpenCV distance transform", "openCvDistanceTransform/repeats:5/real_time", 10),
    ("brush, 21 styles, 4K", "brushHeld/process_time/real_time", "OpenCV phase and remap",
     "openCvPhaseRemap/process_time/real_time", 1.5),
    ("brush, polar, 21 styles, 4K", "brushPolar/process_time/real_time", "OpenCV phase and remap",
     "openCvPhaseRemap/process_time/real_time", 3.5),
    ("brush, seed's mapping, 21 styles, 4K", "brushSeed/process_time/real_time",
     "OpenCV phase and remap", "openCvPhaseRemap/process_time/real_time", None),
    ("coverage, 20,000 triangles, 2K", "coverage/20000/process_time/real_time",
     "Embree, 64 rays a pixel", "embree64/20000/process_time/real_time", 2),
]


def row(name, peer, ratio, gate, kept):
    verdict = "" if gate is None else ("kept" if kept else "MISSED")
    limit = "" if gate is None else f"{gate:g}x"
    print(f"| {name} | {peer} | {ratio:.2f}x | {limit} | {verdict} |")


def main(path):
    with open(path, encoding="utf-8") as file:
        run = json.load(file)
    context = run["context"]
    times = {b["run_name"]: b["real_time"] for b in run["benchmarks"]
             if "real_time" in b and b.get("aggregate_name", "median") == "median"}
    print(f"{context['date'][:10]}, {context['num_cpus']} cores at {context['mhz_per_cpu']} MHz, "
          f"load {os.getloadavg()[0]:.1f}\n")
    print("| part | peer | ratio | gate | |\n|---|---|---|---|---|")
    missed = 0
    for table, faster in ((FASTER, True), (AT_MOST, False)):
        for name, ours, peer, theirs, gate in table:
            if ours not in times or theirs not in times:
                continue
            ratio = times[theirs] / times[ours] if faster else times[ours] / times[theirs]
            kept = gate is None or (ratio >= gate if faster else ratio <= gate)
            missed += not kept
            row(name, peer + (" (times faster)" if faster else " (times its time)"), ratio, gate, kept)
    for bench in run["benchmarks"]:
        if bench.get("error_occurred"):
            print(f"| {bench['name']} | {bench['error_message']} | | | |")
            missed += not bench["error_message"].endswith("not installed")
        if "growth" in bench:
            kept = bench["growth"] <= 1.5
            missed += not kept
            print(f"| surfaces, pair and mean: {bench['label']}, {bench['ns_per_pixel']:.0f} ns a pixel "
                  f"| a quarter of the frame (cost a pixel, times) | {bench['growth']:.2f}x | 1.5x | "
                  f"{'kept' if kept else 'MISSED'} |")
        if "gate" in bench:
            kept = bench["ratio"] >= bench["gate"]
            missed += not kept
            row(bench["name"].removesuffix("/iterations:1"), f"{bench['label']} (times faster)",
                bench["ratio"], bench["gate"], kept)
        if "bytes_per_pixel" in bench:
            kept = 0 < bench["bytes_per_pixel"] <= 200
            missed += not kept
            print(f"| coverage, 20,000 triangles, 2K: peak memory | | "
                  f"{bench['bytes_per_pixel']:.0f} bytes a pixel | 200 | "
                  f"{'kept' if kept else 'MISSED'} |")
        for counter, label, gate in (("ratio_oiio", "EXR zip read, 20 channels", 3.5),
                                     ("ratio_core", "EXR zip read, against openexr:core", 2)):
            if counter in bench:
                missed += bench[counter] < gate
                row(label, "OIIO (times faster)", bench[counter], gate, bench[counter] >= gate)
        if bench["name"].startswith("exrWrite/4"):
            for counter, gate in (("fast_ratio", 5), ("small_ratio", 2.5)):
                missed += bench[counter] < gate
                row(f"EXR zip write, RGBA, {counter[:-6]}", "OIIO (times faster)", bench[counter],
                    gate, bench[counter] >= gate)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
