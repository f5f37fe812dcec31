# SPDX-License-Identifier: GPL-3.0-or-later
"""Three-component vectors as plain tuples, so that the maths can be tested without Blender."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, factor):
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def normalize(a, otherwise=(0.0, 0.0, 1.0)):
    """`a` at length 1; `otherwise` where `a` has no length."""
    size = length(a)
    return scale(a, 1.0 / size) if size > 1e-12 else otherwise


def perpendicular_frame(axis):
    """Two unit vectors b1, b2 with b1 x b2 = `axis` (unit), from the shortest turn of +Z to it.

    Turns smoothly with the axis; the one place where it must jump is axis = -Z.
    """
    x, y, z = axis
    if z < -0.9999999:
        return (0.0, -1.0, 0.0), (-1.0, 0.0, 0.0)
    a = 1.0 / (1.0 + z)
    b = -x * y * a
    return (1.0 - x * x * a, b, -x), (b, 1.0 - y * y * a, -y)
