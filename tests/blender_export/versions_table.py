# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what several Blenders exported with what this machine's did, as a Markdown table.

    versions_table.py KAGEFUDE FOLDER SUITE ...     called by tests/blender_versions.sh

Ends with 1 where masks differ in more than 0.01 % of the pixels outside silhouettes, where the
comped visibility differs by more than 0.005 RMSE, or where a version is missing.
"""

import glob
import json
import math
import os
import subprocess
import sys

from depth_maps import DepthMap, depth_pairs
from exr_pixels import read_exr

EXAMPLES = ("still_life", "moving_light")
MOST_MASK_SHARE = 1e-4
MOST_VISIBILITY_RMSE = 0.005
HEAD = ("| Blender | shot | masks | normals | positions | ids | depth map | visibility |\n"
        "|---|---|---|---|---|---|---|---|")


class Frame:
    """One exported frame; channel names end in upper case whatever version wrote them."""

    def __init__(self, folder, name):
        documents = glob.glob(os.path.join(folder, name, f"{name}.*.json"))
        if len(documents) != 1:
            raise FileNotFoundError(f"no frame in {folder}/{name}")
        with open(documents[0], encoding="utf-8") as file:
            self.document = json.load(file)
        self.folder = os.path.dirname(documents[0])
        self.channels = self.read(self.document["image"])
        self.comp = glob.glob(os.path.join(self.folder, "comp.*.exr"))[0]

    def read(self, image):
        channels, _ = read_exr(os.path.join(self.folder, image))
        return {name[:-1] + name[-1].upper(): rows for name, rows in channels.items()}

    def masks(self):
        return [sample["layer"] + ".V" for light in self.document["lights"]
                for sample in light["masks"]["samples"]]

    def depth_maps(self):
        for light in self.document["lights"]:
            yield DepthMap(light["depth_map"], self.read(light["depth_map"]["file"])["Depth.V"])


def silhouettes(ids):
    """True where a pixel's 3 x 3 neighbours are not all of one object."""
    height = len(ids)
    return [[len({*near[0][max(x - 1, 0):x + 2], *near[1][max(x - 1, 0):x + 2],
                  *near[2][max(x - 1, 0):x + 2]}) > 1 for x in range(len(ids[0]))]
            for near in ([ids[max(y - 1, 0)], ids[y], ids[min(y + 1, height - 1)]]
                         for y in range(height))]


def flat(rows):
    return [value for row in rows for value in row]


def mask_shares(reference, other):
    """(share of mask pixels that differ outside silhouettes, share of all)."""
    edge = flat(silhouettes(reference.channels["data.IndexOB.V"]))
    inside = differing = everywhere = 0
    for name in reference.masks():
        pairs = zip(flat(reference.channels[name]), flat(other.channels[name]), edge)
        wrong = [on_edge for one, two, on_edge in pairs if one != two]
        everywhere += len(wrong)
        differing += wrong.count(False)
        inside += edge.count(False)
    return differing / inside, everywhere / (len(edge) * len(reference.masks()))


def rms(reference, other, kind):
    """RMSE of a pass's three channels outside silhouettes, where single pixels may flip."""
    edge = flat(silhouettes(reference.channels["data.IndexOB.V"]))
    squares = [(one - two) ** 2 for name in (f"data.{kind}.{axis}" for axis in "XYZ")
               for one, two, on_edge in zip(flat(reference.channels[name]),
                                            flat(other.channels[name]), edge) if not on_edge]
    return math.sqrt(sum(squares) / len(squares))


def depth_difference(reference, other):
    """RMSE of the lights' depth maps, relative to the depth, away from silhouettes.

    A map is framed by what the shot shows in shadow, so that one pixel of a mask turns it. Hence
    points of one map are looked up in the other.
    """
    squares = [(wanted / found - 1.0) ** 2 for first, second in
               zip(reference.depth_maps(), other.depth_maps())
               for wanted, found in depth_pairs(first, second)]
    return math.sqrt(sum(squares) / len(squares))


def visibility_difference(kagefude, reference, other):
    worst = 0.0
    for light in reference.document["lights"]:
        said = subprocess.run([kagefude, "compare", other.comp, reference.comp, "--channel",
                               "visibility." + light["name"], "--json"],
                              check=True, capture_output=True, text=True).stdout
        worst = max(worst, json.loads(said)["rmse"])
    return worst


def row(kagefude, version, name, reference, other):
    """(the table's line, whether it keeps to what is allowed)."""
    outside, everywhere = mask_shares(reference, other)
    ids = sum(one != two for one, two in zip(flat(reference.channels["data.IndexOB.V"]),
                                             flat(other.channels["data.IndexOB.V"])))
    visibility = visibility_difference(kagefude, reference, other)
    normals, positions = (rms(reference, other, kind) for kind in ("Normal", "Position"))
    line = (f"| {version} | {name} | {100 * outside:.4f} % ({100 * everywhere:.4f} %) "
            f"| {normals:.1e} | {positions:.1e} | {ids} "
            f"| {depth_difference(reference, other):.1e} | {visibility:.5f} |")
    return line, outside <= MOST_MASK_SHARE and visibility <= MOST_VISIBILITY_RMSE


def main(kagefude, folder, suites):
    good = True

    def version(place):
        try:
            with open(os.path.join(folder, place + ".version"), encoding="utf-8") as file:
                return file.read().strip() or place
        except OSError:
            return place
    print(f"Each against Blender {version('here')}. Masks: pixels that differ outside silhouettes "
          f"(everywhere); normals, positions: RMSE outside silhouettes; ids: pixels that differ; "
          f"depth map: RMSE as a share of the depth; visibility as comped: RMSE.\n\n{HEAD}")
    for name in EXAMPLES:
        for suite in suites:
            try:
                reference, other = (Frame(os.path.join(folder, place), name)
                                    for place in ("here", suite))
            except (OSError, IndexError) as problem:
                print(f"| {version(suite)} | {name} | not reached: {problem} | | | | | |")
                good = False
                continue
            line, kept = row(kagefude, version(suite), name, reference, other)
            print(line, flush=True)
            good = good and kept
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:]))
