#!/usr/bin/env bash
# Measures how still strokes lie on a walking character's skin, beside a rigid copy that moves as it
# does, and on instances beside a real object: exports the shots with Blender (kept in
# build/quality/skin), comps them in a strip of pure grain, held to the object and to its rest
# positions, times the brush pass and the export with and without rest, and prints the tables. Exit 1
# when a demand is missed. Takes about five minutes on an idle core.
#   tests/quality/skin.sh [MODEL.glb]     without a model the character is built by script
set -euo pipefail
cd "$(dirname "$0")/../.."
model=${1:-}
kind=$([ -n "$model" ] && echo fox || echo built)
out=build/quality/skin/$kind
kagefude=${KAGEFUDE:-build/release/kagefude}
blender=${BLENDER:-blender}
first=1 last=6
[ -x "$kagefude" ] || { echo "build $kagefude first" >&2; exit 2; }
mkdir -p "$out"
TIMEFORMAT='%U %S'

# export SCRIPT SHOT FOLDER
export_shot() {
  $blender -b -t 1 "$out/$2/$2.blend" --python-exit-code 3 -P "$1" -- --output "$3/$2.####.exr" \
    --frames $first-$last --masks disc:5 --depth-size 256 >>"$out/$2/blender.log" 2>&1
}
for shot in walk rigid instances; do
  folder=$out/$shot
  [ -f "$folder/done" ] && [ ! tests/quality/skin_scenes.py -nt "$folder/done" ] && continue
  echo "rendering $shot" >&2
  mkdir -p "$folder"
  $blender -b --factory-startup --python-exit-code 3 -P tests/quality/skin_scenes.py -- \
    "$shot" "$folder/$shot.blend" ${model:+"$model"} >"$folder/blender.log" 2>&1
  if [ $shot = walk ]; then
    { time export_shot blender_export/export_aovs.py walk "$folder/aovs"; } 2>"$out/export_rest.txt"
    { time export_shot tests/quality/export_without_rest.py walk "$folder/plain"; } 2>"$out/export_plain.txt"
    rm -r "$folder/plain"
  else
    export_shot blender_export/export_aovs.py $shot "$folder/aovs"
  fi
  touch "$folder/done"
done

python3 tests/quality/skin_table.py --grain "$out/grain.png"
settings=(--set 'style[0].colour="replace"' --set "style[0].strip=$PWD/$out/grain.png"
  --set output.colour=float --set 'output.layers=[]')
for shot in walk rigid instances; do
  for ground in object rest; do
    "$kagefude" comp tests/quality/brush.toml "$out/$shot/aovs/$shot.####.exr" \
      -o "$out/$shot/$ground/$shot.####.exr" --frames $first-$last --progress none \
      "${settings[@]}" --set "brush.ground=$ground" >/dev/null
  done
done
# Turn by turn, and the middle one counts, for whatever else the machine does; it should be idle.
for turn in 1 2 3; do for ground in object rest; do
  "$kagefude" bench tests/quality/brush.toml "$out/walk/aovs/walk.000$first.exr" --threads 1 --rounds 10 \
    --json "${settings[@]}" --set "brush.ground=$ground" >"$out/brush_$ground.$turn.json"
done; done
python3 tests/quality/skin_table.py "$out" $first $last $kind
