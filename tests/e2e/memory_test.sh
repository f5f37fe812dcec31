#!/usr/bin/env bash
# A frame's memory beyond its input planes: under 40 bytes a pixel for the pair search and the brush.
# Peak memory of two sizes of the same frame; their difference leaves out what does not grow.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 - "$PWD/build/release/kagefude" "$PWD/tests/data/still" "$work" <<'PY'
import json, os, subprocess, sys

kagefude, data, work = sys.argv[1:]
with open(f"{data}/shot.0001.json", encoding="utf-8") as file:
    sidecar = json.load(file)
masks = sidecar["lights"][0]["masks"]
masks["arrangement"] = "pair"
masks["samples"] = [dict(masks["samples"][1], uv=[1, 0]), dict(masks["samples"][5], uv=[-1, 0])]


def peak(width, height):
    name = f"{work}/{width}"
    subprocess.run(["oiiotool", f"{data}/shot.0001.exr", "--resample:interp=0", f"{width}x{height}",
                    "-o", f"{name}.exr"], check=True)
    with open(f"{name}.json", "w", encoding="utf-8") as file:
        json.dump(sidecar, file)
    os.link(f"{data}/shot.Key.depth.0001.exr", f"{work}/shot.Key.depth.0001.exr") \
        if not os.path.exists(f"{work}/shot.Key.depth.0001.exr") else None
    process = subprocess.Popen([kagefude, "comp", "", f"{name}.exr", "-o", f"{name}_out.exr",
                                "--threads", "2", "--progress", "none"])
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0, f"comp of {width}x{height} failed"
    return usage.ru_maxrss * 1024


small, large = (960, 540), (3840, 2160)
pixels = large[0] * large[1] - small[0] * small[1]
growth = (peak(*large) - peak(*small)) / pixels
# Position, normal, colour, beauty, ids, and the Cryptomatte's first rank; masks as bytes. Of the
# other ranks little more than the edges is kept.
inputs = 4 * (3 + 3 + 3 + 4 + 1) + 4 * (1 + 1) + 2
beyond = growth - inputs
print(f"{growth:.0f} bytes a pixel, {inputs} of them input planes, {beyond:.0f} beyond")
print(f"{int(beyond < 40)} passed, {int(beyond >= 40)} failed")
sys.exit(beyond >= 40)
PY
