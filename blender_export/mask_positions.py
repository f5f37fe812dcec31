# SPDX-License-Identifier: GPL-3.0-or-later
"""Where on a light its hard shadow masks are taken from.

Every arrangement gives two unit axes u, v in the world and a place (u, v) per mask in units of
the offset. With `travel` the direction from the light to its subject, u x v = travel for lines and
discs, so that a ring runs counter-clockwise as seen from the subject. For a pair, u is the axis
itself, pointing away from the subject (000 eq. 3.1).
"""

import math
from dataclasses import dataclass

from . import vectors
from .arguments import Arrangement


# From how many times its width on a rectangle is a line. Measured: at 50, with 17 and 33 masks, a
# line's error is two thirds of a grid's; at 5, with 5, 9 and 33, half as much again. The bound lies
# between the two by judgement.
NARROW = 16.0


@dataclass
class MaskPlaces:
    u_axis: tuple
    v_axis: tuple
    places: list  # (u, v) per mask


def places_on_light(arrangement, travel, surface_axes=None):
    """Axes and places for an arrangement.

    `surface_axes` are the two unit axes of a flat light, the longer first, which lines and discs
    then follow; a light without a surface gets axes that face the subject: level for a line,
    turning smoothly with the light for a disc (one jump, where the light is straight below).
    """
    if arrangement.kind == "pair":
        away = vectors.scale(travel, -1.0)
        side, _ = vectors.perpendicular_frame(away)
        return MaskPlaces(away, side, [(1.0, 0.0), (-1.0, 0.0)])
    if surface_axes:
        u_axis, v_axis = _facing(surface_axes, travel)
    elif arrangement.kind == "line":
        u_axis, v_axis = level_frame(travel)
    else:
        u_axis, back = vectors.perpendicular_frame(vectors.scale(travel, -1.0))
        v_axis = vectors.scale(back, -1.0)
    if arrangement.kind == "trace":
        return MaskPlaces(u_axis, v_axis, [])
    if arrangement.kind == "line":
        return MaskPlaces(u_axis, v_axis, _line(arrangement.count))
    if arrangement.kind == "grid":
        return MaskPlaces(u_axis, v_axis, _grid(arrangement.columns, arrangement.rows))
    return MaskPlaces(u_axis, v_axis, _disc(arrangement.count))


def on_rectangle(count, half_u, half_v):
    """The arrangement of `count` masks (of DISC_MASKS) on a rectangle of these half sides.

    Rows and columns so that neighbours lie as near each other as they can.
    """
    if half_u >= NARROW * half_v:
        return Arrangement("line", count)
    shapes = []
    for rows in range(2, count // 2 + 1):
        columns = count // rows
        # The centre is one of the places where both are odd, else it lies beside them.
        spare = 1 - rows * columns % 2
        if rows <= columns and rows * columns + spare == count:
            gap = max(2.0 * half_u / (columns - 1), 2.0 * half_v / (rows - 1))
            shapes.append((gap, columns, rows))
    _, columns, rows = min(shapes)
    return Arrangement("grid", count, columns, rows)


def level_frame(travel):
    """u level and across the view from the subject, v = travel x u; along Y where travel is upright."""
    u_axis = vectors.normalize(vectors.cross((0.0, 0.0, 1.0), travel), (1.0, 0.0, 0.0))
    return u_axis, vectors.cross(travel, u_axis)


def mask_position(centre, places, place, offset):
    """World position of a mask: `centre` + offset (u u_axis + v v_axis) (000 eq. 3.1, 3.2)."""
    u, v = place
    along = vectors.add(vectors.scale(places.u_axis, u), vectors.scale(places.v_axis, v))
    return vectors.add(centre, vectors.scale(along, offset))


def mask_direction(travel, places, place, offset):
    """Direction of a sun's light from a place on its disc; `offset` is a tangent."""
    return vectors.normalize(mask_position(travel, places, place, -offset))


def _facing(surface_axes, travel):
    u_axis, v_axis = surface_axes
    if vectors.dot(vectors.cross(u_axis, v_axis), travel) < 0.0:
        v_axis = vectors.scale(v_axis, -1.0)
    return u_axis, v_axis


def _line(count):
    return [(2.0 * number / (count - 1) - 1.0, 0.0) for number in range(count)]


def _grid(columns, rows):
    """The centre, the corners, then the other places row by row."""
    lattice = [(u, v) for v, _ in _line(rows) for u, _ in _line(columns)]
    first = [(0.0, 0.0)] + [(u, v) for v in (-1.0, 1.0) for u in (-1.0, 1.0)]
    places = first + [place for place in lattice if place not in first]
    return places


# Radius and turn of the groups of eight that follow the centre: each fills the widest gaps that
# those before it leave, so that larger discs contain smaller ones.
_GROUPS = ((1.0, 0.0), (0.5, 0.5), (1.0, 0.5), (0.75, 0.0), (0.25, 0.0), (0.75, 0.5), (1.0, 0.25),
           (1.0, 0.75))


def _disc(count):
    places = [(0.0, 0.0)]
    for radius, turn in _GROUPS:
        size = min(8, count - len(places))
        angles = [2.0 * math.pi * (number + turn) / size for number in range(size)]
        places += [(radius * math.cos(angle), radius * math.sin(angle)) for angle in angles]
    return places
