#!/usr/bin/env bash
# Measures every shadow method against traced truth: exports the scenes with Blender (kept in
# build/quality, made again when scenes.py changes), comps and compares them, and prints the table.
#   tests/quality/run.sh [SCENE ...]      pictures: build/quality/SCENE/side_by_side.png,
#                                         and all scenes in build/quality/side_by_side.png
set -euo pipefail
cd "$(dirname "$0")/../.."
out=build/quality
kagefude=${KAGEFUDE:-build/release/kagefude}
samples=512
scenes=("$@")
[ ${#scenes[@]} -gt 0 ] || scenes=(ball_and_box column head fence ring crossing foreground large_light wires moving)
[ -x "$kagefude" ] || { echo "build $kagefude first" >&2; exit 2; }

frames_of() { [ "$1" = moving ] && echo 1-12 || echo 1; }

# export_masks SCENE ARRANGEMENT FOLDER [OPTION ...]
export_masks() {
  local scene=$1 masks=$2 folder=$out/$1/$3
  shift 3
  [ -f "$folder/done" ] && [ ! tests/quality/scenes.py -nt "$folder/done" ] && return
  echo "rendering $scene ($masks)" >&2
  mkdir -p "$out/$scene"
  blender -b --factory-startup --python-exit-code 3 -P tests/quality/scenes.py -- \
    "$scene" "$out/$scene/$scene.blend" >"$out/$scene/blender.log" 2>&1
  blender -b "$out/$scene/$scene.blend" --python-exit-code 3 -P blender_export/export_aovs.py -- \
    --output "$folder/$scene.####.exr" --frames "$(frames_of "$scene")" --masks "$masks" "$@" \
    >>"$out/$scene/blender.log" 2>&1
  touch "$folder/done"
}

# measure SCENE METHOD FOLDER [SETTING ...]: comps with the settings and compares every frame.
measure() {
  local scene=$1 method=$2 from=$out/$1/$3 to=$out/$1/$2 set=()
  shift 3
  for setting in "$@"; do set+=(--set "$setting"); done
  "$kagefude" comp tests/quality/measure.toml "$from/$scene.####.exr" -o "$to/$scene.####.exr" \
    --frames "$(frames_of "$scene")" --progress none ${set[@]+"${set[@]}"} 2>"$out/$scene/$method.log"
  judge "$scene" "$method" visibility.Key
}

judge() {
  local scene=$1 method=$2 channel=$3 file name
  for file in "$out/$scene/$method/$scene".????.exr; do
    name=$(basename "$file" .exr)
    "$kagefude" compare "$file" "$out/$scene/disc9/$name.exr" --channel "$channel" \
      --against truth.Key --where data.IndexOB --truth-samples $samples --gain 2 --json \
      --picture "$out/$scene/$method/$name.error.png" >"$out/$scene/$method/$name.json"
  done
}

# The plain average of the nine masks.
average() {
  local scene=$1 file weights masks k
  masks=mask.Key.0.V weights=0.1111111
  for k in 1 2 3 4 5 6 7 8; do masks+=,mask.Key.$k.V weights+=,0.1111111; done
  mkdir -p "$out/$scene/average"
  for file in "$out/$scene/disc9/$scene".????.exr; do
    oiiotool "$file" --ch "$masks" --chsum:weight=$weights --chnames Y \
      -o "$out/$scene/average/$(basename "$file")"
  done
  judge "$scene" average Y
}

for scene in "${scenes[@]}"; do
  export_masks "$scene" disc:9 disc9 --truth $samples
  export_masks "$scene" disc:5 disc5
  export_masks "$scene" disc:17 disc17
  export_masks "$scene" disc:33 disc33
  export_masks "$scene" pair pair
  measure "$scene" hard disc9 light_shape.light_size=0
  measure "$scene" seed_pair pair shadow.method=pair smooth.h=0 pair.bound=none pair.horizon=false
  measure "$scene" pair_in_object pair shadow.method=pair smooth.h=0
  measure "$scene" pair_smooth pair shadow.method=pair
  measure "$scene" pair_depth pair
  measure "$scene" pcss disc9 shadow.method=pcss smooth.h=0
  average "$scene"
  measure "$scene" five_alone disc5 light_shape.depth_map=false
  measure "$scene" five_masks disc5
  measure "$scene" nine_linear disc9 light_shape.disc=linear light_shape.follow=false light_shape.depth_map=false
  measure "$scene" nine_wedges disc9 light_shape.follow=false light_shape.depth_map=false
  measure "$scene" nine_alone disc9 light_shape.depth_map=false
  measure "$scene" nine_masks disc9
  measure "$scene" seventeen_masks disc17
  measure "$scene" thirty_three_masks disc33
done
python3 tests/quality/table.py "$out" "${scenes[@]}"
