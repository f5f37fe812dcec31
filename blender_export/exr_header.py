# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the names of an EXR file's channels, to make sure that what was asked for was written."""

import struct

from .errors import ExportError

LARGEST_HEADER = 16 << 20


def channel_names(path):
    """Names of the channels of a single-part EXR file, in the file's order."""
    with open(path, "rb") as file:
        head = file.read(LARGEST_HEADER)
    if head[:4] != b"\x76\x2f\x31\x01":
        raise ExportError(f"{path} is not an OpenEXR file")
    try:
        return _channels(head, 8)
    except (IndexError, ValueError, struct.error) as problem:
        raise ExportError(f"the header of {path} is damaged") from problem


def _channels(head, place):
    while head[place] != 0:
        name, place = _text(head, place)
        kind, place = _text(head, place)
        (size,) = struct.unpack_from("<i", head, place)
        place += 4
        if name == "channels" and kind == "chlist":
            return _channel_list(head, place)
        place += size
    raise ValueError("no channel list")


def _channel_list(head, place):
    names = []
    while head[place] != 0:
        name, place = _text(head, place)
        names.append(name)
        place += 16  # pixel type, linearity, sampling
    return names


def _text(head, place):
    end = head.index(0, place)
    return head[place:end].decode("utf-8"), end + 1
