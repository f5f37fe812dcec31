# SPDX-License-Identifier: GPL-3.0-or-later
"""Surface points that a rendered frame shows, and which of them lie in a light's shadow.

Asking the scene itself by rays would make Blender sort all of its triangles once more. So the
frame's positions and one mask a light are written a second time, uncompressed, into a file of which
only a coarse grid of pixels is read, and which is then removed.
"""

import os
import struct

from . import exr_header
from .errors import ExportError

COLUMNS, ROWS = 48, 27
OBJECT, POSITION = "IndexOB", "Position"
_HALF, _FLOAT = 1, 2


class SeenPoints:
    """The grid's pixels of an uncompressed EXR of one part with the layers OBJECT, POSITION and masks."""

    def __init__(self, path):
        try:
            with open(path, "rb") as file:
                self._read(file, exr_header.read_layout(file))
        except (KeyError, IndexError, ValueError, struct.error) as problem:
            raise ExportError(f"Blender wrote a damaged file {path}") from problem
        finally:
            os.remove(path)

    def of_mask(self, layer):
        """(point, whether the mask hides it) of every pixel that shows an object."""
        hidden = self._values[layer][0]
        objects, places = self._values[OBJECT][0], zip(*self._values[POSITION])
        return [(place, value < 0.5)
                for thing, place, value in zip(objects, places, hidden) if thing > 0.0]

    def _read(self, file, layout):
        width, height = layout.width, layout.height
        rows = sorted({round(row * (height - 1) / ROWS) for row in range(ROWS + 1)})
        columns = sorted({round(column * (width - 1) / COLUMNS) for column in range(COLUMNS + 1)})
        self._values = {}
        lines = [layout.line(file, row) for row in rows]
        start = 0
        for name, kind in layout.channels:
            size = 2 if kind == _HALF else 4
            form = "<" + ("e" if kind == _HALF else "f" if kind == _FLOAT else "I")
            values = [struct.unpack_from(form, line, start + size * column)[0]
                      for line in lines for column in columns]
            self._values.setdefault(name.rpartition(".")[0], []).append(values)
            start += size * width
