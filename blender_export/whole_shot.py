# SPDX-License-Identifier: GPL-3.0-or-later
"""What holds for the whole shot, so that no frame depends on what it happens to see.

The shot is looked at in a few frames of the scene's own range, the same ones whichever frames are
exported. The subject is what stands in view in at least half of them; its sphere is the middle of
those that it has in these frames.
"""

import statistics
from dataclasses import dataclass

from . import vectors
from .subject import Sphere, bounding_sphere, corners_of

MOST_SAMPLES = 9
# A light's aim travels with it only where that is better by more than this.
CLEARLY_BETTER = 0.2


@dataclass
class LightSample:
    """A light in one sampled frame."""
    position: tuple
    shines: bool
    casts: bool
    unknown_node: str         # a node of the light that could not be followed, or None
    power: float              # luminance of its energy times its colour
    irradiance_at: object     # function of a world point: luminance that arrives there
    on_axis_at: object        # the same, were the point on the light's axis
    sized: bool = True        # False where it is a point
    narrowed: bool = False    # an area light with a spread of less than 180 degrees


@dataclass
class FrameSample:
    """One sampled frame."""
    things: dict              # Thing by name, in view or not
    seen: set                 # names of those that stand in view
    eye: tuple                # the camera's place
    view: tuple               # the way it looks, unit
    lights: dict              # LightSample by the light's name


@dataclass
class Aim:
    """What a light is aimed at: a place in the world, or one that travels along with the light."""
    place: tuple
    travels: bool = False

    def center(self, position):
        return vectors.add(position, self.place) if self.travels else self.place


@dataclass
class WholeShot:
    first: int
    last: int
    subject: Sphere
    distance: float           # of the subject along the camera's view; 0 where it is never ahead
    centers: list             # of the subject in each sampled frame


def sampled_frames(first, last):
    """At most MOST_SAMPLES frames, evenly spread, both ends among them."""
    last = max(first, last)
    count = min(MOST_SAMPLES, last - first + 1)
    if count == 1:
        return [first]
    return [first + (last - first) * number // (count - 1) for number in range(count)]


def subject_names(samples):
    """Names of what stands in view in at least half of the frames; else in as many as any does."""
    counts = {}
    for sample in samples:
        for name in sample.seen:
            counts[name] = counts.get(name, 0) + 1
    if not counts:
        return set()
    wanted = min((len(samples) + 1) // 2, max(counts.values()))
    return {name for name, count in counts.items() if count >= wanted}


def measure(first, last, samples):
    """The subject over the shot, and where it is in each sample."""
    names = subject_names(samples)
    spheres = [_sphere_of(sample, names) for sample in samples]
    known = [sphere for sphere in spheres if sphere] or [Sphere((0.0, 0.0, 0.0), 0.0)]
    subject = Sphere(_middle([sphere.center for sphere in known]),
                     statistics.median(sphere.radius for sphere in known))
    centers = [(sphere or subject).center for sphere in spheres]
    ahead = [depth for depth in map(_depth, samples, centers) if depth > 0.0]
    return WholeShot(first, last, subject, statistics.median(ahead) if ahead else 0.0, centers)


def _sphere_of(sample, names):
    things = [thing for name, thing in sample.things.items() if name in names]
    return bounding_sphere(corners_of(things)) if things else None


def _depth(sample, center):
    return vectors.dot(vectors.subtract(center, sample.eye), sample.view)


def aim_of(subject_center, centers, positions):
    """What a light is aimed at that is at `positions` while the subject is at `centers`.

    At the whole shot's subject; but a lamp that goes along with a subject on its way keeps the
    direction in which it has it.
    """
    fixed = Aim(subject_center)
    if not positions:
        return fixed
    carried = Aim(_middle([vectors.subtract(center, position)
                           for center, position in zip(centers, positions)]), True)
    pairs = list(zip(centers, positions))
    if _worst(fixed, pairs) > _worst(carried, pairs) + CLEARLY_BETTER:
        return carried
    return fixed


def _worst(aim, pairs):
    """Largest length between the unit directions to the aim and to the subject."""
    return max(vectors.length(vectors.subtract(
        vectors.normalize(vectors.subtract(aim.center(position), position)),
        vectors.normalize(vectors.subtract(center, position)))) for center, position in pairs)


def _middle(points):
    return tuple(statistics.median(point[axis] for point in points) for axis in range(3))
