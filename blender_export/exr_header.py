# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the header of an EXR file of one part: its channels, and where its lines of pixels are."""

import struct
from dataclasses import dataclass

from .errors import ExportError

LARGEST_HEADER = 16 << 20
_UNCOMPRESSED = 0


@dataclass
class Layout:
    """Where an uncompressed file keeps its pixels; a line holds its channels one after the other."""
    width: int
    height: int
    channels: list   # (name, kind: 0 uint, 1 half, 2 float) in the file's order
    offsets: tuple   # of each line's block in the file

    def line(self, file, row):
        """The bytes of a line, 0 the topmost."""
        file.seek(self.offsets[row])
        _, size = struct.unpack("<ii", file.read(8))
        line = file.read(size)
        if len(line) != size:
            raise ValueError("a line ends early")
        return line


def channel_names(path):
    """Names of the channels of a single-part EXR file, in the file's order."""
    with open(path, "rb") as file:
        head = file.read(LARGEST_HEADER)
    if head[:4] != b"\x76\x2f\x31\x01":
        raise ExportError(f"{path} is not an OpenEXR file")
    try:
        return [name for name, _ in _channel_list(_attributes(head, 8)[0]["channels"])]
    except (KeyError, IndexError, ValueError, struct.error) as problem:
        raise ExportError(f"the header of {path} is damaged") from problem


def read_layout(file):
    """The Layout of an open file; ValueError where it is compressed, KeyError and others where damaged."""
    head = file.read(LARGEST_HEADER)
    attributes, place = _attributes(head, 8)
    if attributes["compression"][0] != _UNCOMPRESSED:
        raise ValueError("compressed")
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    height = bottom - top + 1
    return Layout(right - left + 1, height, _channel_list(attributes["channels"]),
                  struct.unpack_from(f"<{height}Q", head, place))


def _attributes(head, place):
    """({name: raw bytes}, where the header ends)."""
    found = {}
    while head[place] != 0:
        name, place = _text(head, place)
        _, place = _text(head, place)
        (size,) = struct.unpack_from("<i", head, place)
        found[name] = head[place + 4:place + 4 + size]
        place += 4 + size
    return found, place + 1


def _channel_list(raw):
    """(name, kind) of each channel."""
    found, place = [], 0
    while raw[place] != 0:
        name, place = _text(raw, place)
        found.append((name, struct.unpack_from("<i", raw, place)[0]))
        place += 16  # pixel type, linearity, sampling
    return found


def _text(raw, place):
    end = raw.index(0, place)
    return raw[place:end].decode("utf-8"), end + 1
