"""Prints the tables of tests/quality/skin.sh; exit 1 when strokes miss a demand.

    python3 tests/quality/skin_table.py --grain OUT.png           the strip of pure grain
    python3 tests/quality/skin_table.py FOLDER FIRST LAST KIND    the tables; KIND: fox or built

Every row of the strip holds the same values, so a change of tone alone changes nothing. Besides the
shots FOLDER holds what was timed: brush_rest.N.json and brush_object.N.json of `kagefude bench`, and
export_rest.txt and export_plain.txt with seconds of CPU. Needs numpy.
"""

import json
import os
import struct
import sys
import zlib

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from skin_measure import measure  # noqa: E402  (after the path)

MOST_ABOVE_RIGID = 0.10
MOST_ABOVE_REAL = 0.05   # of instances
MOST_SLIDE, MOST_WORST = 0.1, 0.5   # pixels a frame, and of the worst 1 %
MOST_JUMP, MOST_SPREAD = 3.0, 0.15
MOST_BRUSH, MOST_EXPORT = 1.25, 1.1
# Legs are below, head and tail beyond these, along the axes of the rest positions.
PARTS = {"fox": {"up": 2, "legs": 30, "long": 1, "from": -35, "to": 45},
         "built": {"up": 2, "legs": 0.68, "long": 1, "from": -0.9, "to": 0.9}}


def write_grain(path, side=256):
    """Smooth noise that repeats, each row of it with the same values."""
    random = np.random.default_rng(7)
    spectrum = np.fft.fft2(random.standard_normal((side, side)))
    across = np.fft.fftfreq(side)[None, :] ** 2 + np.fft.fftfreq(side)[:, None] ** 2
    noise = np.fft.ifft2(spectrum * np.exp(-across * 900)).real
    ranks = noise.argsort(1).argsort(1)
    values = np.sort(noise, 1).mean(0)
    values = np.clip(128 + 44 * values / values.std(), 0, 255).astype(np.uint8)
    rows = np.repeat(values[ranks][:, :, None], 3, 2)
    raw = b"".join(b"\0" + row.tobytes() for row in rows)

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2,
                                                                     0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def body_parts(limit):
    def parts(frame):
        legs = frame.rest[limit["up"]] < limit["legs"]
        along = frame.rest[limit["long"]]
        ends = ~legs & ((along < limit["from"]) | (along > limit["to"]))
        return {"legs": legs, "torso": ~legs & ~ends, "head and tail": ends}
    return parts


def lanes(frame):
    return {"real object": frame.side < -0.8, "first instance": np.abs(frame.side) <= 0.8,
            "second instance": frame.side > 0.8}


class Tables:
    def __init__(self):
        self.missed = []

    def demand(self, what, value, most):
        if not value <= most:
            self.missed.append(f"{what} is {value:.2f}, above {most:.2f}")

    def ratios(self, still, by_object, by_rest):
        print("| part | rigid copy | walking, `ground = \"object\"` | walking, `ground = \"rest\"` | "
              "above the rigid copy |\n|---|---|---|---|---|")
        for part in still.parts():
            above = by_rest.ratio(part) - still.ratio(part)
            self.demand(f"{part} above the rigid copy", above, MOST_ABOVE_RIGID)
            print(f"| {part} | {still.ratio(part):.2f} | {by_object.ratio(part):.2f} | "
                  f"{by_rest.ratio(part):.2f} | {above:+.2f} |")

    def instances(self, by_object, by_rest):
        print("\n| of three that move alike | `ground = \"object\"` | `ground = \"rest\"` |\n|---|---|---|")
        for part in by_rest.parts():
            print(f"| {part} | {by_object.ratio(part):.2f} | {by_rest.ratio(part):.2f} |")
            if part != "real object":
                self.demand(f"{part} above the real object",
                            by_rest.ratio(part) - by_rest.ratio("real object"), MOST_ABOVE_REAL)

    def stillness(self, shots):
        print("\n| strokes | slide on the skin (worst 1 %), pixels a frame | largest jump | contrast "
              "|\n|---|---|---|---|")
        for name, shot, demanded in shots:
            for part in shot.parts():
                (mean, worst), (low, high) = shot.slide(part), shot.contrast(part)
                print(f"| {name}, {part} | {mean:.2f} ({worst:.2f}) | {shot.jump(part):.2f} | "
                      f"{100 * (low - 1):+.0f} to {100 * (high - 1):+.0f} % |")
                if demanded:
                    self.demand(f"{part}'s slide", mean, MOST_SLIDE)
                    self.demand(f"{part}'s worst slide", worst, MOST_WORST)
                    self.demand(f"{part}'s jump", shot.jump(part), MOST_JUMP)
                    self.demand(f"{part}'s contrast", max(1 - low, high - 1), MOST_SPREAD)

    def costs(self, folder):
        brush = brush_seconds(folder, "rest") / brush_seconds(folder, "object")
        export = cpu_seconds(folder, "rest") / cpu_seconds(folder, "plain")
        print(f"\nbrush pass with rest: {brush:.2f} of the held brush without; export with the rest "
              f"pass: {export:.2f} of one without (CPU)")
        self.demand("the brush pass with rest", brush, MOST_BRUSH)
        self.demand("the export with rest", export, MOST_EXPORT)


def brush_seconds(folder, ground):
    """Of the middle turn; placing the rest positions counts as well."""
    turns = []
    for turn in (1, 2, 3):
        with open(os.path.join(folder, f"brush_{ground}.{turn}.json"), encoding="utf-8") as file:
            stages = json.load(file)["stages"]
        turns.append(sum(stage["seconds"] for stage in stages
                         if stage["stage"] in ("styles and tone", "brush")))
    return sorted(turns)[1]


def cpu_seconds(folder, kind):
    with open(os.path.join(folder, f"export_{kind}.txt"), encoding="utf-8") as file:
        return sum(float(word) for word in file.read().split())


def main(folder, first, last, kind):
    frames = range(int(first), int(last) + 1)
    body = body_parts(PARTS[kind])
    still, by_object, by_rest = (measure(folder, shot, ground, frames, body) for shot, ground in
                                 (("rigid", "object"), ("walk", "object"), ("walk", "rest")))
    tables = Tables()
    tables.ratios(still, by_object, by_rest)
    tables.instances(*(measure(folder, "instances", ground, frames, lanes)
                       for ground in ("object", "rest")))
    tables.stillness((("rigid copy", still, False), ("walking by object", by_object, False),
                      ("walking by rest", by_rest, True)))
    tables.costs(folder)
    for line in tables.missed:
        print(f"MISSED: {line}")
    return 1 if tables.missed else 0


if __name__ == "__main__":
    if sys.argv[1] == "--grain":
        write_grain(sys.argv[2])
    else:
        sys.exit(main(*sys.argv[1:]))
