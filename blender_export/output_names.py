# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of the written files and of the layers inside them."""

import glob
import hashlib
import os
import re
from dataclasses import dataclass

from .errors import UsageError

# Blender keeps 29 bytes of a layer's name in a multilayer file: `traced.` or `mask.` and `.63`
# around the light's name leave this much for it.
LONGEST_KEY = 20
LONGEST_LAYER = 29
_PLACE = re.compile(r"#+|%0(\d)d")


@dataclass
class OutputNames:
    """The file names of a sequence, from a pattern such as `out/shot.####.exr`."""
    folder: str
    before: str
    digits: int   # 0: the pattern has no place for a frame number
    after: str

    def image(self, frame):
        return self.before + self._number(frame) + self.after

    def sidecar(self, frame):
        return os.path.splitext(self.image(frame))[0] + ".json"

    def light_depth(self, light_key, frame):
        """`shot.Key.depth.0012.exr` beside `shot.0012.exr`."""
        joint = "" if self.before.endswith((".", "_", "-")) or not self.before else "."
        number = "." + self._number(frame) if self.digits else ""
        safe = re.sub(r'[\\/:*?"<>|\s]', "_", light_key)
        return f"{self.before}{joint}{safe}.depth{number}{self.after}"

    def parts_pattern(self):
        """A glob for the unfinished files that a stopped export leaves behind."""
        return os.path.join(glob.escape(self.folder), f".{glob.escape(self.before)}*.part*")

    def _number(self, frame):
        return f"{frame:0{self.digits + (frame < 0)}d}" if self.digits else ""


def parse_output(pattern, frame_count):
    """The pattern's parts; a lone # is four digits, a longer run is as many as it has."""
    folder, name = os.path.split(os.path.abspath(pattern))
    if not name.lower().endswith(".exr"):
        raise UsageError(f"the output '{pattern}' must end in .exr, as in out/shot.####.exr")
    found = list(_PLACE.finditer(name))
    if len(found) > 1:
        raise UsageError(f"the output '{pattern}' has more than one place for the frame number")
    if not found:
        if frame_count > 1:
            raise UsageError(f"the output '{pattern}' has no #### for the frame number, but "
                             f"{frame_count} frames are to be written")
        return OutputNames(folder, name[:-4], 0, name[-4:])
    place = found[0]
    digits = int(place[1]) if place[1] else {1: 4}.get(len(place[0]), len(place[0]))
    return OutputNames(folder, name[:place.start()], digits, name[place.end():])


def light_keys(names):
    """A short, unique key per light name, for layer and file names: the name itself if it fits."""
    keys = {}
    for name in names:
        keys[name] = name if len(name.encode("utf-8")) <= LONGEST_KEY else _shortened(name)
    return keys


def _shortened(name):
    digest = hashlib.sha1(name.encode("utf-8")).hexdigest()[:6]
    room = LONGEST_KEY - len(digest) - 1
    return name.encode("utf-8")[:room].decode("utf-8", "ignore") + "~" + digest


def mask_layer(light_key, number):
    return f"mask.{light_key}.{number}"


def truth_layer(light_key):
    return f"truth.{light_key}"


def traced_layer(light_key):
    return f"traced.{light_key}"
