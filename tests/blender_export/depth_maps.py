# SPDX-License-Identifier: Apache-2.0
"""Lights' depth maps of two exports, compared at the same places of the world."""

MISS = 1e9          # beyond it nothing was hit
STEP = 8            # of the pixels that are looked up
SILHOUETTE = 0.02   # share by which neighbours differ there


class DepthMap:
    """A depth map with its matrices; depths are distances along the view."""

    def __init__(self, described, rows):
        self.rows, self.size = rows, len(rows)
        self.light_from_world = described["light_from_world"]
        self.across = described["clip_from_light"][0][0]
        self.perspective = described["projection"] == "perspective"

    def place(self, x, y):
        """World place of what pixel (x, y) shows, or None."""
        depth = self.rows[y][x]
        if depth > MISS:
            return None
        scale = (depth if self.perspective else 1.0) / self.across
        seen = ((2.0 * (x + 0.5) / self.size - 1.0) * scale,
                (1.0 - 2.0 * (y + 0.5) / self.size) * scale, -depth)
        moved = [value - row[3] for value, row in zip(seen, self.light_from_world)]
        return [sum(self.light_from_world[row][axis] * moved[row] for row in range(3))
                for axis in range(3)]

    def look_up(self, place):
        """(depth of a world place, depth that the map has there), or None beyond it and at silhouettes."""
        x, y, z = (sum(a * b for a, b in zip(row, place)) + row[3]
                   for row in self.light_from_world[:3])
        scale = self.across / (-z if self.perspective else 1.0)
        column = 0.5 * (1.0 + x * scale) * self.size - 0.5
        line = 0.5 * (1.0 - y * scale) * self.size - 0.5
        left, top = int(column), int(line)
        if z >= 0.0 or not (1 <= left < self.size - 2 and 1 <= top < self.size - 2):
            return None
        near = [self.rows[row][left - 1:left + 3] for row in range(top - 1, top + 3)]
        values = [value for row in near for value in row]
        if max(values) > min(values) * (1.0 + SILHOUETTE):
            return None
        return -z, self._between(near, column - left, line - top)

    def _between(self, near, right, down):
        """Of the four in the middle: flat surfaces are linear in the depth, or in its inverse."""
        turn = (lambda value: 1.0 / value) if self.perspective else (lambda value: value)
        (a, b), (c, d) = ([turn(value) for value in row[1:3]] for row in near[1:3])
        upper, lower = a + (b - a) * right, c + (d - c) * right
        return turn(upper + (lower - upper) * down)


def depth_pairs(reference, other):
    """(depth in `reference`, depth of the same place as `other` has it) of a grid of pixels."""
    for y in range(0, other.size, STEP):
        for x in range(0, other.size, STEP):
            place = other.place(x, y)
            found = place and reference.look_up(place)
            if found:
                yield found[1], found[0]
