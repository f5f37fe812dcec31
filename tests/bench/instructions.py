"""Instructions that hot passes execute on a small frame, against recorded counts, by callgrind.

    python3 tests/bench/instructions.py PROGRAM           compare; exit 1 where a pass takes over 10 % more
    python3 tests/bench/instructions.py PROGRAM --record  write the counts of this program

PROGRAM is kagefude_plain, whose passes are the same code on every machine. Counts need no quiet
machine, so a regression shows that a timing would hide.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

RECORDED = pathlib.Path(__file__).with_name("instructions.json")
TOLERANCE = 1.10
PASSES = {
    "surfaces": ("labelSurfaces", []),
    "nine masks": ("lightShapeVisibility", []),
    "smooth, 21x21": ("smoothWithinSurfaces", ["shadow.method=pcf", "smooth.h=10"]),
    "pcf": ("pcfVisibility", ["shadow.method=pcf"]),
    "pcss": ("pcssVisibility", ["shadow.method=pcss"]),
    "brush": ("applyBrush", []),
    "edges": ("blendEdges", []),
    "read": ("readFramePlanes", []),
}


def count(program, function, settings, folder):
    """Instructions inside one function and what it calls, on one thread."""
    root = pathlib.Path(__file__).resolve().parents[2]
    look = folder / "look.toml"
    look.touch()
    command = ["valgrind", "--tool=callgrind", f"--toggle-collect=kagefude::{function}(*",
               f"--callgrind-out-file={folder}/out", program, "comp", look,
               root / "tests/data/still/shot.0001.exr", "-o", folder / "comped.exr",
               "--threads", "1", "--progress", "none"]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode or not found:
        sys.exit(f"{function}: {done.stderr[-500:]}")
    return int(found.group(1))


def main():
    program, record = sys.argv[1], "--record" in sys.argv[2:]
    recorded = {} if record else json.loads(RECORDED.read_text())
    counts, grown = {}, 0
    print("| pass | million instructions | recorded | |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, (function, settings) in PASSES.items():
            counts[name] = count(program, function, settings, pathlib.Path(folder))
            if counts[name] == 0:
                sys.exit(f"{name}: {function} was not called")
            before = recorded.get(name, counts[name])
            more = counts[name] > TOLERANCE * before
            grown += more
            print(f"| {name} | {counts[name] / 1e6:.1f} | {before / 1e6:.1f} "
                  f"| {'GROWN' if more else 'kept'} |", flush=True)
    if record:
        RECORDED.write_text(json.dumps(counts, indent=1) + "\n")
    return 1 if grown else 0


if __name__ == "__main__":
    sys.exit(main())
