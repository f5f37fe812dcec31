# SPDX-License-Identifier: GPL-3.0-or-later
"""Frame ranges, read strictly: `7`, `1-10`, `10-1`, `1-10x2`, `1-10:2`, `1..10`, `-5--1`, lists."""

import re

from .errors import UsageError

_PIECE = re.compile(r"(-?\d+)(?:(?:-|\.\.)(-?\d+)(?:[x:](\d+))?)?")
MOST_FRAMES = 1_000_000


def parse_frames(text):
    """The frames that `text` names, each once, in the order given; UsageError where unclear."""
    pieces = [piece for piece in re.split(r"[,\s]+", text.strip()) if piece]
    if not pieces:
        raise UsageError("the frame range is empty; expected something like 1-24, 1-24x2 or 1,5,9")
    frames = {}
    for piece in pieces:
        for frame in _frames_of(piece):
            frames[frame] = None
            if len(frames) > MOST_FRAMES:
                raise UsageError(f"the frame range '{text}' names more than {MOST_FRAMES} frames")
    return list(frames)


def _frames_of(piece):
    match = _PIECE.fullmatch(piece)
    if not match:
        raise UsageError(f"'{piece}' is not a frame range; expected something like 7, 1-24 or 1-24x2")
    first = int(match[1])
    last = int(match[2]) if match[2] else first
    step = int(match[3]) if match[3] else 1
    if step == 0:
        raise UsageError(f"the frame range '{piece}' has a step of 0")
    return range(first, last + 1, step) if last >= first else range(first, last - 1, -step)
