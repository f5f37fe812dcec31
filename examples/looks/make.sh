#!/usr/bin/env bash
# Makes a look of every preset for frames, and compares them on one sheet a frame.
#   examples/looks/make.sh KAGEFUDE OUT [NAME=FRAME...]
# Looks, strips and previews go to OUT/NAME, the sheet to OUT/NAME.png. Without frames those that examples/run.sh
# has rendered are taken: the still life and, if it is there, the walk. With oiiotool, OUT/NAME.jpg is the sheet as
# the README shows it.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: examples/looks/make.sh KAGEFUDE OUT [NAME=FRAME...]" >&2; exit 2; }
kagefude=$1 out=$2
shift 2
here=$(cd "$(dirname "$0")/.." && pwd)
frames=("$@")
if [ $# -eq 0 ]; then
  for shot in still_life.0001 walk.0009; do
    frame=$here/out/${shot%.*}/aovs/$shot.exr
    [ -f "$frame" ] && frames+=("${shot%.*}=$frame")
  done
  [ ${#frames[@]} -gt 0 ] || { echo "no frames: run examples/run.sh first, or name some" >&2; exit 2; }
fi
for entry in "${frames[@]}"; do
  name=${entry%%=*} frame=${entry#*=}
  for preset in oil gouache cel ink pastel watercolour; do
    "$kagefude" look new "$frame" -o "$out/$name/$preset.toml" --preset "$preset" --force \
      --preview "$out/$name/$preset.png"
  done
  "$kagefude" sheet --looks "$out/$name" "$frame" -o "$out/$name.png"
  if command -v oiiotool >/dev/null; then
    oiiotool "$out/$name.png" --ch R,G,B -d uint8 --compression jpeg:88 -o "$out/$name.jpg"
  fi
done
