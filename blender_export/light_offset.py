# SPDX-License-Identifier: GPL-3.0-or-later
"""The masks' offset worked out from the physical light (`--offset auto`)."""

# The masks stand apart even in a frame in which the light has shrunk to a point.
LEAST_SHARE = 1e-5


def area_offsets(radius, area):
    """Half axes of an ellipse on which a disc's masks lie, half sides of a rectangle's grid."""
    half_u, half_v = area["half_u"], area["half_v"]
    least = LEAST_SHARE * max(radius, half_u, LEAST_SHARE)
    return max(half_u, least), max(half_v, least)


def auto_offset(kind, radius, half_length, distance, subject_radius):
    """Offset of the outermost masks for a light of `radius` (world units; a sun's is a tangent).

    Line: the light's own half length; disc: its own radius. Pair: a blocker edge at lateral
    distance x and depth d from the light gets a band of the true width when l = r d / x. x is the
    subject's radius and d the distance to its centre: right at the subject's rim, too narrow
    inside it, but nowhere so wide that the two shadows part, which is the worse fault. Both masks
    must stay outside the subject, so l is at most half the way to its bounding sphere, and at
    most a quarter of the distance where the light is inside it.
    """
    size = half_length if kind == "line" else radius
    least = LEAST_SHARE * max(distance, LEAST_SHARE)
    if kind != "pair":
        return max(size, least)
    edge = max(subject_radius, 1e-6 * distance)
    room = distance - subject_radius
    most = max(0.5 * room, 0.25 * distance if room <= 0.0 else 0.05 * distance)
    return max(min(radius * distance / edge, most), least)
