# SPDX-License-Identifier: GPL-3.0-or-later
"""What a light lights: the bounding sphere of the things in view that are not the stage itself."""

from dataclasses import dataclass

from . import vectors

FLAT_SHARE = 0.02


@dataclass
class Thing:
    """An object in the world: its name, the eight corners of its bounds, and whether it is flat."""
    name: str
    corners: list
    flat: bool

    def box(self):
        low = tuple(min(corner[axis] for corner in self.corners) for axis in range(3))
        high = tuple(max(corner[axis] for corner in self.corners) for axis in range(3))
        return low, high


@dataclass
class Sphere:
    center: tuple
    radius: float


def is_flat(low, high):
    """True where the thinnest extent of a box is under 2 % of the largest."""
    extents = [top - bottom for bottom, top in zip(low, high)]
    return min(extents) < FLAT_SHARE * max(extents)


def bounding_sphere(points):
    """The middle of the points' box and the distance of the farthest; radius 0 without points."""
    if not points:
        return Sphere((0.0, 0.0, 0.0), 0.0)
    low = [min(point[axis] for point in points) for axis in range(3)]
    high = [max(point[axis] for point in points) for axis in range(3)]
    center = tuple(0.5 * (a + b) for a, b in zip(low, high))
    return Sphere(center, max(vectors.length(vectors.subtract(point, center)) for point in points))


def in_view(thing, clip_from_world):
    """False where the bounding sphere lies wholly outside one side of the camera's frustum."""
    sphere = bounding_sphere(thing.corners)
    rows = clip_from_world
    for axis in (0, 1):
        for sign in (1.0, -1.0):
            plane = [w + sign * a for w, a in zip(rows[3], rows[axis])]
            if _outside(plane, sphere):
                return False
    return not _outside([w + z for w, z in zip(rows[3], rows[2])], sphere)


def subject_things(things, clip_from_world):
    """The standing things in view; all in view, or all there are, where that leaves nothing."""
    seen = [thing for thing in things if in_view(thing, clip_from_world)] or things
    return standing_things(seen) or seen


def standing_things(things):
    """Things that are not grounds, walls and rooms, which only receive.

    Left out are flat things, and things whose box holds the middles of more than half of the others.
    """
    thick = [thing for thing in things if not thing.flat]
    return [thing for thing in thick if not _is_room(thing, thick)] or thick


def corners_of(things):
    return [corner for thing in things for corner in thing.corners]


def _outside(plane, sphere):
    normal = tuple(plane[:3])
    return vectors.dot(normal, sphere.center) + plane[3] < -sphere.radius * vectors.length(normal)


def _is_room(thing, things):
    others = [other for other in things if other is not thing]
    low, high = thing.box()
    middles = [bounding_sphere(other.corners).center for other in others]
    inside = sum(all(a <= m <= b for a, m, b in zip(low, middle, high)) for middle in middles)
    return len(others) > 1 and 2 * inside > len(others)
