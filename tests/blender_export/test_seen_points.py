# SPDX-License-Identifier: GPL-3.0-or-later
import os
import struct
import tempfile
import unittest

from paths import exporter

seen_points, errors = exporter("seen_points"), exporter("errors")
WIDTH, HEIGHT = 97, 55


def position(x, y):
    return (x + 0.5, y - 0.25, 0.125 * x)


def has_object(x, y):
    return (x + y) % 3 > 0


def hidden(x, y):
    return x > y


def attribute(name, kind, raw):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(raw)) + raw


def picture(compression=0, left=-3, top=7):
    """An uncompressed EXR; object numbers as halves, as some writers keep them."""
    kinds = {"IndexOB.V": 1, "Position.X": 2, "Position.Y": 2, "Position.Z": 2, "mask.Key.0.V": 2}
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iiii", kind, 0, 1, 1)
                        for name, kind in kinds.items()) + b"\0"
    window = struct.pack("<4i", left, top, left + WIDTH - 1, top + HEIGHT - 1)
    head = b"\x76\x2f\x31\x01" + struct.pack("<i", 2) \
        + attribute("channels", "chlist", channels) \
        + attribute("compression", "compression", bytes([compression])) \
        + attribute("dataWindow", "box2i", window) + b"\0"
    lines = []
    for y in range(HEIGHT):
        row = range(WIDTH)
        line = struct.pack(f"<{WIDTH}e", *(float(has_object(x, y)) for x in row))
        for axis in range(3):
            line += struct.pack(f"<{WIDTH}f", *(position(x, y)[axis] for x in row))
        line += struct.pack(f"<{WIDTH}f", *(0.0 if hidden(x, y) else 1.0 for x in row))
        lines.append(struct.pack("<ii", top + y, len(line)) + line)
    start = len(head) + 8 * HEIGHT
    offsets = [start + sum(map(len, lines[:y])) for y in range(HEIGHT)]
    return head + struct.pack(f"<{HEIGHT}Q", *offsets) + b"".join(lines)


class SeenPoints(unittest.TestCase):
    def read(self, data):
        with tempfile.NamedTemporaryFile(delete=False) as file:
            file.write(data)
        try:
            return seen_points.SeenPoints(file.name)
        finally:
            self.assertFalse(os.path.exists(file.name))

    def test_the_grid_reaches_every_edge_and_leaves_the_background_out(self):
        found = self.read(picture()).of_mask("mask.Key.0")
        wanted = {position(x, y): hidden(x, y)
                  for y in {round(row * (HEIGHT - 1) / seen_points.ROWS)
                            for row in range(seen_points.ROWS + 1)}
                  for x in {round(column * (WIDTH - 1) / seen_points.COLUMNS)
                            for column in range(seen_points.COLUMNS + 1)} if has_object(x, y)}
        self.assertEqual(dict(found), wanted)
        self.assertEqual(len(found), len(wanted))
        self.assertEqual({0.5, WIDTH - 0.5}, {min(p[0] for p, _ in found), max(p[0] for p, _ in found)})

    def test_a_damaged_or_compressed_file_is_one_clear_error(self):
        for data in (picture(compression=3), picture()[:-3000], b"", picture()[:40]):
            with self.assertRaises(errors.ExportError):
                self.read(data)


if __name__ == "__main__":
    unittest.main()
