"""Prints the table of tests/quality/brush.sh; exit 1 when held strokes miss a demand.

    python3 tests/quality/brush_table.py build/quality/brush SCENE ...
"""

import json
import os
import sys

STRIPS = ("soft", "fine")
METHODS = (("seed", "seed's mapping"), ("polar", "polar"), ("tone", "held, `grain = \"tone\"`"),
           ("held", "**held**"), ("screen", "held, `size = \"screen\"`"))
MOST_EXCESS = 1 / 3   # of the seed's
MOST_JUMP = 3.0       # of the sequence's median
MOST_SPREAD = 0.15    # of the strokes' contrast


def read(folder, scene, strip, method):
    path = os.path.join(folder, scene, f"{strip}_{method}.json")
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def spread(measure):
    return f"{100 * (measure['low'] - 1):+.0f} to {100 * (measure['high'] - 1):+.0f} %"


def misses(where, share, jump, contrast):
    if share > MOST_EXCESS:
        yield f"{where}: excess {share:.2f} of the seed's, above 1/3"
    if jump > MOST_JUMP:
        yield f"{where}: a jump of {jump:.2f} medians"
    if max(1 - contrast["low"], contrast["high"] - 1) > MOST_SPREAD:
        yield f"{where}: contrast strays by more than 15 %"


def main(folder, scenes):
    missed = []
    print("| shot | strip | strokes | warp error | excess | of the seed's | strokes alone | "
          "of the seed's | largest jump | contrast | grain |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for scene in scenes:
        for strip in STRIPS:
            seed = read(folder, scene, strip, "seed")["warp_error"]
            for method, name in METHODS:
                r = read(folder, scene, strip, method)
                if r is None:
                    continue
                error, jump = r["warp_error"], r["jump"]["largest_to_median"]
                contrast = r["strokes"]["contrast"]
                share = error["excess"] / seed["excess"]
                print(f"| {scene} | {strip} | {name} | {error['picture']:.4f} | "
                      f"{error['excess']:+.4f} | {share:.2f} | {error['strokes']:.4f} | "
                      f"{error['strokes'] / seed['strokes']:.2f} | {jump:.2f} | "
                      f"{spread(contrast)} | {spread(r['strokes']['grain'])} |")
                if method in ("held", "screen"):
                    missed += misses(f"{scene}, {strip}, {method}", share, jump, contrast)
    for line in missed:
        print(f"MISSED: {line}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
