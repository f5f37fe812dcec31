"""Prints the table of tests/quality/brush.sh; exit 1 when held strokes miss a demand.

    python3 tests/quality/brush_table.py build/quality/brush SCENE ...
"""

import json
import os
import sys

STRIPS = ("soft", "fine")
METHODS = (("seed", "seed's mapping"), ("polar", "polar"), ("held", "**held**"))
MOST_EXCESS = 1 / 3   # of the seed's
MOST_JUMP = 3.0       # of the sequence's median
MOST_SPREAD = 0.15    # of the strokes' contrast


def read(folder, scene, strip, method):
    with open(os.path.join(folder, scene, f"{strip}_{method}.json"), encoding="utf-8") as file:
        return json.load(file)


def main(folder, scenes):
    missed = []
    print("| shot | strip | strokes | warp error | of the unstyled tone | excess | of the seed's "
          "excess | largest jump | contrast over the shot |")
    print("|---|---|---|---|---|---|---|---|---|")
    for scene in scenes:
        for strip in STRIPS:
            seed = read(folder, scene, strip, "seed")["warp_error"]["excess"]
            for method, name in METHODS:
                r = read(folder, scene, strip, method)
                error, jump, contrast = r["warp_error"], r["jump"], r["strokes"]["contrast"]
                share = error["excess"] / seed
                print(f"| {scene} | {strip} | {name} | {error['picture']:.4f} | "
                      f"{error['unstyled']:.4f} | {error['excess']:.4f} | {share:.2f} | "
                      f"{jump['largest_to_median']:.2f} | {100 * (contrast['low'] - 1):+.0f} to "
                      f"{100 * (contrast['high'] - 1):+.0f} % |")
                if method != "held":
                    continue
                where = f"{scene}, {strip}"
                if share > MOST_EXCESS:
                    missed.append(f"{where}: excess {share:.2f} of the seed's, above 1/3")
                if jump["largest_to_median"] > MOST_JUMP:
                    missed.append(f"{where}: a jump of {jump['largest_to_median']:.2f} medians")
                if max(1 - contrast["low"], contrast["high"] - 1) > MOST_SPREAD:
                    missed.append(f"{where}: contrast strays by more than 15 %")
    for line in missed:
        print(f"MISSED: {line}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
