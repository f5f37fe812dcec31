# SPDX-License-Identifier: GPL-3.0-or-later
"""The exporter's command line: everything after Blender's `--`."""

import argparse
from dataclasses import dataclass, field

from .errors import UsageError, nearest
from .frame_ranges import parse_frames

DISC_MASKS = (5, 9, 17, 33, 65)
MOST_LINE_MASKS = 64
MOST_SAMPLES = 65536
MASK_BACKENDS = ("auto", "layers", "groups", "occlusion", "raycast")


@dataclass
class Arrangement:
    """How the shadow masks lie on a light: `pair`, `line` or `disc`, and how many there are.

    Or `trace`: no masks but the traced visibility, and how many samples a pixel it takes. What the
    exporter makes of a disc by itself: `grid` on a rectangle, with `columns` along its longer side,
    and `hard`, the one mask of a light of no size.
    """
    kind: str = "disc"
    count: int = 9
    columns: int = 0
    rows: int = 0


@dataclass
class Options:
    output: str = ""
    frames: list = None          # None: the frame the file was saved at
    lights: list = field(default_factory=list)  # empty: every light that renders
    masks: Arrangement = field(default_factory=Arrangement)
    masks_by: str = "auto"       # one of MASK_BACKENDS
    offset: float = None         # None: from the light's size; world units, for a sun a tangent
    truth_samples: int = 0       # 0: no truth layer
    scale: int = 1
    percentage: int = 100        # of that size, for previews
    depth_size: int = 1024
    casters: bool = False        # also write the triangles of casting objects


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise UsageError(message)


def parse_masks(text):
    """`pair`, `line:K` with K from 2 to 64, `disc:K` with K of DISC_MASKS, or `trace:N`."""
    kind, _, number = text.partition(":")
    if text == "pair":
        return Arrangement("pair", 2)
    if kind == "disc" and number in map(str, DISC_MASKS):
        return Arrangement("disc", int(number))
    if kind == "line" and number.isascii() and number.isdigit() \
            and 2 <= int(number) <= MOST_LINE_MASKS:
        return Arrangement("line", int(number))
    if kind == "trace" and number.isascii() and number.isdigit() \
            and 1 <= int(number) <= MOST_SAMPLES:
        return Arrangement("trace", int(number))
    discs = [f"disc:{count}" for count in DISC_MASKS]
    raise UsageError(f"'{text}' is not an arrangement of masks (pair, line:2 to "
                     f"line:{MOST_LINE_MASKS}, {', '.join(discs)}, trace:1 to trace:{MOST_SAMPLES})"
                     f"{nearest(text, ['pair', 'line:5', *discs, 'trace:64'])}")


def parse_backend(text):
    if text not in MASK_BACKENDS:
        raise UsageError(f"'{text}' is not a way to render masks ({', '.join(MASK_BACKENDS)})"
                         f"{nearest(text, list(MASK_BACKENDS))}")
    return text


def parse_offset(text):
    if text == "auto":
        return None
    try:
        offset = float(text)
    except ValueError:
        offset = 0.0
    if not 0.0 < offset < float("inf"):
        raise UsageError(f"'{text}' is not an offset; expected auto or a length above 0")
    return offset


def _whole_number(name, lowest, highest):
    def parse(text):
        digits = text.isascii() and text.isdigit()
        if not digits or not lowest <= int(text) <= highest:
            raise UsageError(f"--{name} takes a whole number from {lowest} to {highest}, "
                             f"not '{text}'")
        return int(text)
    return parse


def build_parser():
    parser = _Parser(prog="blender -b SHOT.blend --python-exit-code 3 -P export_aovs.py --",
                     allow_abbrev=False,
                     description="Render the passes, shadow masks and light-depth maps that "
                                 "kagefude comps.")
    parser.add_argument("--output", required=True, metavar="DIR/shot.####.exr",
                        help="where to write; #### becomes the frame number")
    parser.add_argument("--frames", type=parse_frames, metavar="RANGE",
                        help="1-24, 1-24x2, 1,5,9 (default: the frame the file was saved at)")
    parser.add_argument("--light", action="append", default=[], metavar="NAME", dest="lights",
                        help="a light to export, may be repeated (default: every light that "
                             "renders and casts shadows)")
    parser.add_argument("--masks", type=parse_masks, default=Arrangement(), metavar="HOW",
                        help="pair, line:K, or disc:K with K 5, 9, 17, 33 or 65 (default: disc:9); "
                             "thin shadows of wide lights need the larger discs; trace:N takes "
                             "no masks but the light's own soft shadow, traced with N samples")
    parser.add_argument("--masks-by", type=parse_backend, default="auto", metavar="HOW",
                        help="auto, layers (a render a mask), groups (light groups), or by rays, "
                             "all masks in one sample: raycast (Blender 5.1 on) or occlusion; what "
                             "rays cannot do right is done by layers (default: auto)")
    parser.add_argument("--offset", type=parse_offset, default=None, metavar="L",
                        help="distance of the outermost masks from the light's centre in world "
                             "units, for a sun the tangent of the angle, or auto: from the "
                             "light's own size (default: auto)")
    parser.add_argument("--truth", type=_whole_number("truth", 1, MOST_SAMPLES), default=0,
                        metavar="SAMPLES", dest="truth_samples",
                        help="also trace each light at its real size with so many samples")
    parser.add_argument("--scale", type=_whole_number("scale", 1, 8), default=1, metavar="N",
                        help="render N times the file's resolution, 1 to 8 (default: 1)")
    parser.add_argument("--percentage", type=_whole_number("percentage", 1, 100), default=100,
                        metavar="P", help="of that size, for a quick look (default: 100)")
    parser.add_argument("--depth-size", type=_whole_number("depth-size", 16, 16384), default=1024,
                        metavar="PIXELS", help="side of the light-depth maps (default: 1024)")
    parser.add_argument("--casters", action="store_true",
                        help="also write the triangles of the objects that cast shadows, for the "
                             "shadow methods that need their shape")
    return parser


def parse_arguments(words):
    """Options from the words after `--`; UsageError, or SystemExit after --help."""
    return Options(**vars(build_parser().parse_args(words)))
