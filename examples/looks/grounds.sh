#!/usr/bin/env bash
# Lays the two examples on four grounds: a wash on rough paper, oil on canvas, pastel on dark laid paper, and a
# painted sky behind the walk.
#   examples/looks/grounds.sh KAGEFUDE OUT [STILL_LIFE WALK]
# Frames and strips are those of examples/run.sh --walk, or the frames named. OUT/NAME.png are the pictures; with
# oiiotool, OUT/grounds.jpg shows the four as the README does.
set -euo pipefail
[ $# -eq 2 ] || [ $# -eq 4 ] || { echo "usage: examples/looks/grounds.sh KAGEFUDE OUT [STILL_LIFE WALK]" >&2; exit 2; }
here=$(cd "$(dirname "$0")/.." && pwd)
kagefude=$1 out=$2
still=${3:-$here/out/still_life/aovs/still_life.0001.exr}
walk=${4:-$here/out/walk/aovs/walk.0009.exr}
mkdir -p "$out"

# painted NAME LOOK FRAME SETTING...
painted() {
  local name=$1 look=$2 frame=$3 settings=() setting
  shift 3
  for setting in "$@"; do settings+=(--set "$setting"); done
  "$kagefude" comp "$here/$look.toml" "$frame" -o "$out/$name.exr" --preview "$out/previews" --progress none \
    "${settings[@]}"
  mv "$out/previews/$name.png" "$out/$name.png"
}

painted wash still_life "$still" output.background=paper paper.kind=rough paper.strength=0.3 paper.grain=2.5 \
  paper.pressure=0.96 paper.by_tone=0.8 'paper.colour=[0.9, 0.86, 0.78]' edges.rough=1 edges.overrun=-0.5 \
  edges.rim=4 edges.rim_strength=0.35 edges.lost=8
painted oil still_life "$still" output.background=paper paper.kind=canvas paper.strength=0.3 paper.grain=3 \
  paper.pressure=0.9 'paper.colour=[0.35, 0.22, 0.12]' edges.rough=2 edges.lost=14 'tint.shadow=[0.2, 0.25, 0.6]' \
  tint.shadow_strength=0.3
painted pastel still_life "$still" output.background=paper paper.kind=laid paper.strength=0.8 paper.grain=3 \
  paper.pressure=0.75 paper.by_tone=-0.3 'paper.colour=[0.12, 0.11, 0.12]' edges.rough=2 edges.dry=0.4 \
  edges.dry_width=24
painted sky walk "$walk" output.background=strip ground.strip=out/strips/sky.png ground.fixed=world ground.width=60 \
  paper.kind=canvas paper.strength=0.2 paper.grain=3 paper.pressure=0.92 edges.rough=1.5 edges.lost=8
rmdir "$out/previews"
if command -v oiiotool >/dev/null; then
  for name in wash oil pastel sky; do oiiotool "$out/$name.png" --resize 960x0 --cut 960x540+0+0 -o "$out/$name.small.png"; done
  oiiotool "$out"/{wash,oil,pastel,sky}.small.png --mosaic:pad=4 2x2 --resize 1280x720 --ch R,G,B -d uint8 \
    --compression jpeg:88 -o "$out/grounds.jpg"
  rm "$out"/*.small.png
fi
