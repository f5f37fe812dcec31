"""Prints the table of tests/quality/skin.sh; exit 1 when strokes move on the skin beyond a demand.

    python3 tests/quality/skin_table.py --grain OUT.png          the strip of pure grain
    python3 tests/quality/skin_table.py FOLDER FIRST LAST [fox]  the table

Of every pixel that two frames show, by the motion vectors: the strokes' change over their own
deviation (unrelated strokes have the root of 2), over legs, body, and head and tail, told apart by
their rest positions. Every row of the strip holds the same values, so a change of tone alone
changes nothing. Needs numpy.
"""

import os
import struct
import sys
import zlib

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from exr_planes import read_planes  # noqa: E402  (after the path)

CHANNELS = "IndexOB.V", "Vector.X", "Vector.Y", "Rest.R", "Rest.G", "Rest.B"
MOST_ABOVE_RIGID = 0.10
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


def sample(plane, x, y):
    """Catmull-Rom over 4 x 4 pixels."""
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)

    def weights(f):
        return (-.5 * f + f ** 2 - .5 * f ** 3, 1 - 2.5 * f ** 2 + 1.5 * f ** 3,
                .5 * f + 2 * f ** 2 - 1.5 * f ** 3, -.5 * f ** 2 + .5 * f ** 3)
    across, down = weights(x - left), weights(y - top)
    height, width = plane.shape
    return sum(across[i] * down[j] * plane[np.clip(top + j - 1, 0, height - 1),
                                           np.clip(left + i - 1, 0, width - 1)]
               for j in range(4) for i in range(4))


def shifted(plane, x, y):
    return np.roll(np.roll(plane, y, 0), x, 1)


class Frame:
    def __init__(self, aovs, picture):
        planes = read_planes(aovs, ["data." + name for name in CHANNELS])
        ids, x, y, *rest = planes.values()
        self.ids, self.motion, self.rest = ids, (x, y), np.stack(rest)
        self.strokes = read_planes(picture, ["R"])["R"]


def compared(now, before):
    """Where both frames show the same skin, and where it was."""
    height, width = now.ids.shape
    rows, columns = np.mgrid[0:height, 0:width]
    x, y = columns + now.motion[0], rows - now.motion[1]
    seen = (now.ids > 0) & (x > 2) & (y > 2) & (x < width - 3) & (y < height - 3)
    for j in (-1, 0, 1):
        for i in (-1, 0, 1):
            seen &= shifted(now.ids, i, j) == now.ids
    column, row = np.round(x).astype(int), np.round(y).astype(int)
    for j in range(-2, 3):
        for i in range(-2, 3):
            seen &= before.ids[np.clip(row + j, 0, height - 1),
                               np.clip(column + i, 0, width - 1)] == now.ids
    moved = np.stack([sample(axis, x, y) for axis in before.rest])
    error = np.sqrt(((moved - now.rest) ** 2).sum(0))
    step = np.sqrt(((shifted(now.rest.transpose(1, 2, 0), -1, 0).transpose(2, 0, 1)
                     - now.rest) ** 2).sum(0))
    size = np.abs(now.rest[:, now.ids > 0]).max()
    return seen & (error < 1.5 * np.maximum(step, 1e-6) + 0.002 * size), x, y


def parts(frame, kind):
    limit = PARTS[kind]
    legs = frame.rest[limit["up"]] < limit["legs"]
    along = frame.rest[limit["long"]]
    ends = ~legs & ((along < limit["from"]) | (along > limit["to"]))
    return {"legs": legs, "torso": ~legs & ~ends, "head and tail": ends}


def ratios(folder, shot, ground, first, last, kind):
    found, before = {}, None
    for number in range(first, last + 1):
        now = Frame(f"{folder}/{shot}/aovs/{shot}.{number:04}.exr",
                    f"{folder}/{shot}/{ground}/{shot}.{number:04}.exr")
        if before:
            seen, x, y = compared(now, before)
            old = sample(before.strokes, x, y)
            for name, part in parts(now, kind).items():
                taken = seen & part
                if taken.sum() >= 50:
                    strokes = now.strokes[taken]
                    change = np.sqrt(((strokes - old[taken]) ** 2).mean())
                    found.setdefault(name, []).append(change / strokes.std())
        before = now
    return {name: float(np.mean(values)) for name, values in found.items()}


def main(folder, first, last, kind="built"):
    table = {(shot, ground): ratios(folder, shot, ground, int(first), int(last), kind)
             for shot, ground in (("rigid", "object"), ("walk", "object"), ("walk", "rest"))}
    print("| part | rigid copy | walking, `ground = \"object\"` | walking, `ground = \"rest\"` | "
          "above the rigid copy |\n|---|---|---|---|---|")
    missed = 0
    for part, still in table["rigid", "object"].items():
        above = table["walk", "rest"][part] - still
        missed += above > MOST_ABOVE_RIGID
        print(f"| {part} | {still:.2f} | {table['walk', 'object'][part]:.2f} | "
              f"{table['walk', 'rest'][part]:.2f} | {above:+.2f} |")
    if missed:
        print(f"MISSED: {missed} parts are more than {MOST_ABOVE_RIGID:.2f} above the rigid copy")
    return 1 if missed else 0


if __name__ == "__main__":
    if sys.argv[1] == "--grain":
        write_grain(sys.argv[2])
    else:
        sys.exit(main(*sys.argv[1:]))
