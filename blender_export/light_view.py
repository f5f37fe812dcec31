# SPDX-License-Identifier: GPL-3.0-or-later
"""The camera of a light-depth map: placed at the light, framed on what matters to the shot.

A blocker of a visible point lies on the line from that point to the light, so framing the visible
points that lie in shadow frames every blocker that matters; the corners of the subject are framed
too, for shadows that fall between the probing rays. What lies outside the map is lit. Matrices are
lists of rows, for column vectors.
"""

import math
from dataclasses import dataclass

from . import vectors

WIDEST = math.radians(150.0)   # beyond that a flat map has no texels left for the middle
NARROWEST = math.radians(0.5)
MARGIN = 1.12                  # the penumbra, and what the probing rays missed


@dataclass
class LightView:
    projection: str        # "perspective" or "orthographic"
    world_from_light: list
    clip_from_light: list
    extent: float          # full angle in radians, or full width in world units
    near: float
    far: float
    cut: bool = False      # some visible points are outside the map


def perspective_view(position, framed, visible, cone=None):
    """Frames the points `framed`, or all that are `visible` where that takes a narrower cone.

    `cone` = (direction, full angle) of a spot, where that is narrower still.
    """
    axis, angle = min((_cone_of(position, points) for points in (framed, visible) if points),
                      key=lambda found: found[1])
    wanted = 2.0 * math.atan(math.tan(min(angle, 0.49 * math.pi)) * MARGIN)
    if cone and cone[1] < wanted:
        axis, wanted = cone[0], min(cone[1] * MARGIN, WIDEST)
        cut = False
    else:
        cut = wanted > WIDEST
    extent = min(max(wanted, NARROWEST), WIDEST)
    reach = max(vectors.length(vectors.subtract(point, position)) for point in [*framed, *visible])
    near, far = 1e-3 * reach, 2.0 * reach
    focal = 1.0 / math.tan(0.5 * extent)
    clip = [[focal, 0.0, 0.0, 0.0], [0.0, focal, 0.0, 0.0],
            [0.0, 0.0, (far + near) / (near - far), 2.0 * far * near / (near - far)],
            [0.0, 0.0, -1.0, 0.0]]
    return LightView("perspective", look_along(position, axis), clip, extent, near, far, cut)


def orthographic_view(direction, framed, visible, casters):
    """The same for light travelling along `direction`, from beyond all `casters`."""
    frame = look_along((0.0, 0.0, 0.0), direction)
    right, up = [tuple(row[column] for row in frame[:3]) for column in (0, 1)]
    middle, half = (0.0, 0.0, 0.0), 0.0
    for axis in (right, up):
        low, high = _narrower(_range(axis, framed), _range(axis, visible))
        middle = vectors.add(middle, vectors.scale(axis, 0.5 * (low + high)))
        half = max(half, 0.5 * (high - low))
    depths = [vectors.dot(point, direction) for point in [*framed, *visible, *casters]]
    span = max(max(depths) - min(depths), half, 1e-6)
    start = min(depths) - 0.1 * span
    position = vectors.add(middle, vectors.scale(direction, start))
    extent = max(2.0 * half * MARGIN, 1e-6)
    near, far = 0.01 * span, 1.3 * span
    clip = [[2.0 / extent, 0.0, 0.0, 0.0], [0.0, 2.0 / extent, 0.0, 0.0],
            [0.0, 0.0, 2.0 / (near - far), (far + near) / (near - far)], [0.0, 0.0, 0.0, 1.0]]
    return LightView("orthographic", look_along(position, direction), clip, extent, near, far)


def _cone_of(position, points):
    rays = [vectors.subtract(point, position) for point in points]
    return bounding_cone([vectors.normalize(ray) for ray in rays if vectors.length(ray) > 1e-9])


def _range(axis, points):
    along = [vectors.dot(point, axis) for point in points]
    return (min(along), max(along)) if along else None


def _narrower(one, other):
    """The part that two ranges share, or the one that is there."""
    if not one or not other:
        return one or other
    low, high = max(one[0], other[0]), min(one[1], other[1])
    return (low, high) if low < high else other


def look_along(position, direction):
    """World-from-camera matrix of a camera that looks along `direction` (unit), its own -Z."""
    back = vectors.scale(direction, -1.0)
    right = vectors.normalize(vectors.cross((0.0, 0.0, 1.0), back), (1.0, 0.0, 0.0))
    up = vectors.cross(back, right)
    return [[right[row], up[row], back[row], position[row]] for row in range(3)] \
        + [[0.0, 0.0, 0.0, 1.0]]


def rigid_inverse(matrix):
    """Inverse of a rotation with a translation."""
    rows = [[matrix[column][row] for column in range(3)] for row in range(3)]
    shift = [matrix[row][3] for row in range(3)]
    return [[*row, -sum(a * b for a, b in zip(row, shift))] for row in rows] \
        + [[0.0, 0.0, 0.0, 1.0]]


def bounding_cone(directions):
    """A narrow cone round unit `directions`: its axis and half angle (pi where they surround).

    Moves the axis toward the farthest direction by ever smaller steps, after Badoiu and Clarkson.
    """
    total = (0.0, 0.0, 0.0)
    for direction in directions:
        total = vectors.add(total, direction)
    axis = vectors.normalize(total, (0.0, 0.0, -1.0))
    for step in range(1, 64):
        farthest = min(directions, key=lambda direction: vectors.dot(direction, axis), default=axis)
        moved = vectors.add(axis, vectors.scale(vectors.subtract(farthest, axis), 1.0 / (step + 1)))
        axis = vectors.normalize(moved, axis)
    lowest = min((vectors.dot(direction, axis) for direction in directions), default=1.0)
    return axis, math.acos(max(-1.0, min(1.0, lowest)))
