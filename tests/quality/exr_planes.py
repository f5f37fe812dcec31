"""Reads float planes of a scanline ZIP file into arrays, for the tables of large pictures."""

import os
import struct
import sys
import zlib

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "blender_export"))

import exr_pixels  # noqa: E402  (after the path)


def read_planes(path, names):
    """{name: rows by columns} of the named channels of a single-part 32-bit ZIP file."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, place = exr_pixels._attributes(data, 8)
    channels = exr_pixels._channel_names(attributes["channels"])
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    assert attributes["compression"][0] == 3, "not ZIP"
    picked = [channels.index(name) for name in names]
    planes = np.empty((len(names), height, width))
    chunks = -(-height // exr_pixels.LINES_PER_CHUNK)
    for offset in struct.unpack_from(f"<{chunks}Q", data, place):
        first, size = struct.unpack_from("<ii", data, offset)
        lines = min(exr_pixels.LINES_PER_CHUNK, bottom + 1 - first)
        raw = _unpacked(data[offset + 8:offset + 8 + size], lines * width * 4 * len(channels))
        rows = raw.view("<f4").reshape(lines, len(channels), width)
        for number, channel in enumerate(picked):
            planes[number, first - top:first - top + lines] = rows[:, channel]
    return dict(zip(names, planes))


def _unpacked(packed, size):
    """Undoes ZIP: inflates, sums up, and puts the two halves of bytes back in turn."""
    if len(packed) == size:
        return np.frombuffer(packed, np.uint8).copy()
    deltas = np.frombuffer(zlib.decompress(packed), np.uint8).astype(np.int64)
    deltas[1:] -= 128
    sums = np.cumsum(deltas).astype(np.uint8)
    half = (size + 1) // 2
    raw = np.empty(size, np.uint8)
    raw[0::2], raw[1::2] = sums[:half], sums[half:]
    return raw
