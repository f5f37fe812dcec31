# SPDX-License-Identifier: GPL-3.0-or-later
"""The masks' offset worked out from the physical light (`--offset auto`)."""

from .errors import ExportError


def auto_offset(kind, name, radius, half_length, distance, subject_radius):
    """Offset of the outermost masks for a light of `radius` (world units; a sun's is a tangent).

    Line: the light's own half length; disc: its own radius. Pair: a blocker edge at lateral
    distance x and depth d from the light gets a band of the true width when l = r d / x. x is the
    subject's radius and d the distance to its centre: right at the subject's rim, too narrow
    inside it, but nowhere so wide that the two shadows part, which is the worse fault. Both masks
    must stay outside the subject, so l is at most half the way to its bounding sphere, and at
    most a quarter of the distance where the light is inside it. ExportError where the light has
    no size.
    """
    size = half_length if kind == "line" else radius
    if size <= 0.0:
        raise ExportError(f"light '{name}' has no size to take the masks' offset from; give it a "
                          f"radius or state the offset, as in --offset 0.2")
    if kind != "pair":
        return size
    edge = max(subject_radius, 1e-6 * distance)
    room = distance - subject_radius
    most = max(0.5 * room, 0.25 * distance if room <= 0.0 else 0.05 * distance)
    return min(radius * distance / edge, most)
