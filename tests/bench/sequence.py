"""Measures what sequence.sh says: medians of runs that take turns, each into a folder of its own."""

import argparse
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

from timed import Gates, load
from whole_frame import copy_words, make_bench_frame, median, run

KAGEFUDE = os.environ.get("KAGEFUDE", "build/release/kagefude")
MEMORY_OF_PROGRAM = 64 << 20  # as tests/e2e/memory_long.sh allows beside --max-memory
UNITS = {"M": 1 << 20, "G": 1 << 30}


def make_frames(folder, options):
    make_bench_frame(KAGEFUDE, folder, "--size", options.size)
    (folder / "in").mkdir()
    for number in range(1, options.frames + 1):
        for suffix in ("exr", "json"):
            os.link(folder / f"frame.{suffix}", folder / "in" / f"shot.{number:04}.{suffix}")


def disk_words(folder, written):
    """Reads every input; writes each of the frames that a comp wrote, and waits for the disk."""
    return ["sh", "-ec", f"cd {shlex.quote(str(folder))}; mkdir disk; cat in/*.exr >/dev/null; "
            f"for each in {written}/*.exr; do "
            "dd if=$each of=disk/${each##*/} bs=4M conv=fsync status=none; done"]


def in_turns(folder, options):
    """{name: what each of its runs took}, and the bytes read and written by ours."""
    frames = f"1-{options.frames}"
    commands = {
        "kagefude": [KAGEFUDE, "comp", folder / "look.toml", folder / "in" / "shot.####.exr", "-o",
                     folder / "kagefude" / "shot.####.exr", "--frames", frames, "--max-memory",
                     options.max_memory, "--progress", "none"],
        "oiiotool": ["oiiotool", "--frames", frames, folder / "in" / "shot.%04d.exr",
                     *copy_words(folder / "oiiotool" / "shot.%04d.exr")],
        "disk": disk_words(folder, "kagefude")}
    (folder / "oiiotool").mkdir()
    took = {name: [] for name in commands}
    for _ in range(options.rounds):
        for name, command in commands.items():
            took[name].append(run(command))
            made = len(list((folder / name).glob("*.exr")))
            if made != options.frames:
                sys.exit(f"{name} made {made} of {options.frames} frames")
        size = {name: sum(file.stat().st_size for file in (folder / name).glob("*.exr"))
                for name in ("in", "kagefude", "oiiotool")}
        for name in commands:  # so that nobody writes over frames that are there
            shutil.rmtree(folder / name)
        (folder / "oiiotool").mkdir()
    return took, size


def report(took, size, options):
    print("| seconds a frame | frames a second | wall | user | system | cores busy | peak memory |\n"
          "|---|---|---|---|---|---|---|")
    wall, cpu = ({name: median(each, kind) / options.frames for name, each in took.items()}
                 for kind in ("wall", "cpu"))
    for name, each in took.items():
        seconds = " | ".join(f"{median(each, kind) / options.frames:.3f}"
                             for kind in ("wall", "user", "system"))
        print(f"| {name} | {1 / wall[name]:.2f} | {seconds} | {median(each, 'busy'):.0%} | "
              f"{median(each, 'peak') / 1e9:.2f} GB |")
    read, *written = (f"{total / options.frames / 1e6:.1f}" for total in size.values())
    print(f"\nMB a frame: {read} read, written {written[0]} by kagefude and {written[1]} by oiiotool\n")
    gates = Gates()
    ratio = wall["kagefude"] / wall["oiiotool"]
    gates.add("kagefude, times oiiotool's time a frame", ratio, "<= 0.22x", ratio <= 0.22)
    gates.note("the same in CPU seconds", f"{cpu['kagefude'] / cpu['oiiotool']:.2f}x")
    gates.note("kagefude, times the disk's time", f"{wall['kagefude'] / wall['disk']:.1f}x")
    busy = 100 * median(took["kagefude"], "busy")
    gates.add("all cores busy", busy, "> 90 %", busy > 90, " %")
    peak = max(each.peak for each in took["kagefude"])
    bound = int(options.max_memory[:-1]) * UNITS[options.max_memory[-1]] + MEMORY_OF_PROGRAM
    gates.add("its peak memory", peak / 1e9, f"<= {bound / 1e9:.2f} GB", peak <= bound, " GB")
    return gates.missed


def main():
    parser = argparse.ArgumentParser(prog="sequence.sh", allow_abbrev=False)
    parser.add_argument("--frames", default=50, type=int)
    parser.add_argument("--size", default="3840x2160")
    parser.add_argument("--rounds", default=3, type=int)
    parser.add_argument("--max-memory", default="4G", help="whole M or G")
    options = parser.parse_args()
    if options.max_memory[-1:] not in UNITS or not options.max_memory[:-1].isdigit():
        parser.error("--max-memory takes a whole number of M or G")
    print(f"{options.frames} frames of {options.size}, medians of {options.rounds}; load {load()} before")
    os.makedirs("build", exist_ok=True)  # on the disk of the work, where /tmp may be memory
    with tempfile.TemporaryDirectory(dir="build", prefix="sequence.") as name:
        folder = pathlib.Path(name)
        make_frames(folder, options)
        # Starts the programs once, so that none of them is read from the disk in the first round.
        subprocess.run([KAGEFUDE, "--version"], check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["oiiotool", "--version"], check=True, stdout=subprocess.DEVNULL)
        missed = report(*in_turns(folder, options), options)
    print(f"load {load()} after")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
