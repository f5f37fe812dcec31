# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads float channels of a scanline ZIP file with nothing but Python, for small test pictures."""

import itertools
import struct
import zlib

LINES_PER_CHUNK = 16


def read_exr(path):
    """({channel: rows of floats}, {attribute: raw bytes}) of a single-part 32-bit ZIP file."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, place = _attributes(data, 8)
    names = _channel_names(attributes["channels"])
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    assert attributes["compression"][0] == 3, "not ZIP"
    channels = {name: [] for name in names}
    chunks = -(-height // LINES_PER_CHUNK)
    for offset in struct.unpack_from(f"<{chunks}Q", data, place):
        top, size = struct.unpack_from("<ii", data, offset)
        lines = min(LINES_PER_CHUNK, y1 + 1 - top)
        raw = _unpack(data[offset + 8:offset + 8 + size], lines * width * 4 * len(names))
        for line in range(lines):
            for number, name in enumerate(names):
                start = (line * len(names) + number) * width * 4
                channels[name].append(struct.unpack_from(f"<{width}f", raw, start))
    return channels, attributes


def bits(value):
    """The bits of a float, as Cryptomatte ids are kept."""
    return struct.unpack("<I", struct.pack("<f", value))[0]


def _attributes(data, place):
    found = {}
    while data[place] != 0:
        end = data.index(0, place)
        name = data[place:end].decode()
        place = data.index(0, end + 1) + 1
        (size,) = struct.unpack_from("<i", data, place)
        found[name] = data[place + 4:place + 4 + size]
        place += 4 + size
    return found, place + 1


def _channel_names(raw):
    names, place = [], 0
    while raw[place] != 0:
        end = raw.index(0, place)
        names.append(raw[place:end].decode())
        assert struct.unpack_from("<i", raw, end + 1)[0] == 2, "not 32-bit float"
        place = end + 17
    return names


def _unpack(packed, size):
    """Undo ZIP: inflate, running sums, and the two halves of bytes put back in turn."""
    if len(packed) == size:
        return packed
    deltas = zlib.decompress(packed)
    sums = bytes(value & 0xFF for value in itertools.accumulate(deltas, lambda a, b: a + b - 128))
    raw = bytearray(size)
    half = (size + 1) // 2
    raw[0::2], raw[1::2] = sums[:half], sums[half:]
    return bytes(raw)
