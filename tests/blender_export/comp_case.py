# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes that are rendered, exported and comped, to be held against what Blender itself renders."""

import os
import subprocess

from blender_case import BlenderCase
from exr_pixels import read_exr
from paths import REPOSITORY

KAGEFUDE = os.environ.get("KAGEFUDE", os.path.join(REPOSITORY, "build", "release", "kagefude"))

LOOK = """
kagefude = 1
[output]
layers = ["brush.tone", "visibility.*"]
colour = "float"
[[style]]
object = "*"
strip = "builtin:neutral"
"""


class CompCase(BlenderCase):
    def comp(self, *settings, look=LOOK, output="out/s", to="comp/c"):
        """What the program said of comping all exported frames."""
        path = self.path("look.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(look)
        words = [word for setting in settings for word in ("--set", setting)]
        result = subprocess.run([KAGEFUDE, "comp", path, self.path(f"{output}.####.exr"), "-o",
                                 self.path(f"{to}.####.exr"), "--progress", "none", *words],
                                capture_output=True, text=True, timeout=300)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout + result.stderr

    def comped(self, frame, to="comp/c"):
        return read_exr(self.path(f"{to}.{frame:04}.exr"))[0]


def flat(rows):
    return [value for row in rows for value in row]


def rmse(pairs):
    pairs = list(pairs)
    return (sum((one - other) ** 2 for one, other in pairs) / len(pairs)) ** 0.5


def inside(*channels):
    """For every pixel whether it and its eight neighbours agree in all the channels and are there."""
    def whole(row, column):
        block = [tuple(rows[y][x] for rows in channels) for y in range(row - 1, row + 2)
                 for x in range(column - 1, column + 2)]
        return block[0][0] != 0.0 and all(
            abs(one - other) < 1e-4 for values in block for one, other in zip(values, block[4]))
    height, width = len(channels[0]), len(channels[0][0])
    return [0 < y < height - 1 and 0 < x < width - 1 and whole(y, x)
            for y in range(height) for x in range(width)]
