#!/usr/bin/env bash
# Measures how still strokes lie on a walking character's skin, beside a rigid copy that moves as it
# does: exports both with Blender (kept in build/quality/skin), comps them in a strip of pure grain,
# held to the object and to its rest positions, and prints the table. Exit 1 when a demand is missed.
#   tests/quality/skin.sh [MODEL.glb]     without a model the character is built by script
set -euo pipefail
cd "$(dirname "$0")/../.."
model=${1:-}
kind=$([ -n "$model" ] && echo fox || echo built)
out=build/quality/skin/$kind
kagefude=${KAGEFUDE:-build/release/kagefude}
first=1 last=6
[ -x "$kagefude" ] || { echo "build $kagefude first" >&2; exit 2; }

for shot in walk rigid; do
  folder=$out/$shot
  if [ ! -f "$folder/done" ] || [ tests/quality/skin_scenes.py -nt "$folder/done" ]; then
    echo "rendering $shot" >&2
    mkdir -p "$folder"
    blender -b --factory-startup --python-exit-code 3 -P tests/quality/skin_scenes.py -- \
      "$shot" "$folder/$shot.blend" ${model:+"$model"} >"$folder/blender.log" 2>&1
    blender -b "$folder/$shot.blend" --python-exit-code 3 -P blender_export/export_aovs.py -- \
      --output "$folder/aovs/$shot.####.exr" --frames $first-$last --masks disc:5 --depth-size 256 \
      >>"$folder/blender.log" 2>&1
    touch "$folder/done"
  fi
done
python3 tests/quality/skin_table.py --grain "$out/grain.png"
for shot in walk rigid; do
  for ground in object rest; do
    "$kagefude" comp tests/quality/brush.toml "$out/$shot/aovs/$shot.####.exr" \
      -o "$out/$shot/$ground/$shot.####.exr" --frames $first-$last --progress none \
      --set "style[0].colour=\"replace\"" --set "style[0].strip=$PWD/$out/grain.png" --set output.colour=float \
      --set 'output.layers=[]' --set "brush.ground=$ground"
  done
done
python3 tests/quality/skin_table.py "$out" $first $last $kind
