# SPDX-License-Identifier: GPL-3.0-or-later
"""Which properties of a data-block may change from frame to frame."""

from . import compat


def is_animated(block, *names):
    """True where a curve or driver acts on a property of these names, or where that cannot be told.

    The non-linear editor's strips count as acting on everything.
    """
    animation = block.animation_data if block is not None else None
    if animation is None:
        return False
    if len(animation.nla_tracks):
        return True
    curves = [*animation.drivers, *compat.action_curves(animation.action)]
    return any(curve.data_path.rpartition(".")[2] in names for curve in curves)
