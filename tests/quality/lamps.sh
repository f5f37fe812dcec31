#!/usr/bin/env bash
# Measures the masks of lamps of every shape against traced truth, with 9 and 17 masks, and prints
# the table: penumbra RMSE, a column a lamp.
#   tests/quality/lamps.sh [LAMP ...]      pictures: build/quality/LAMP/9/LAMP.0001.error.png
set -euo pipefail
cd "$(dirname "$0")/../.."
out=build/quality
kagefude=${KAGEFUDE:-build/release/kagefude}
samples=512
lamps=("$@")
[ ${#lamps[@]} -gt 0 ] || lamps=(disk_lamp ellipse_lamp square_lamp rectangle_lamp tube_lamp)
[ -x "$kagefude" ] || { echo "build $kagefude first" >&2; exit 2; }

# export_masks LAMP COUNT: the truth comes with the nine masks.
export_masks() {
  local lamp=$1 count=$2 folder=$out/$1/$2 truth=()
  [ "$count" != 9 ] || truth=(--truth $samples)
  echo "rendering $lamp ($count masks)" >&2
  mkdir -p "$out/$lamp"
  blender -b --factory-startup --python-exit-code 3 -P tests/quality/scenes.py -- \
    "$lamp" "$out/$lamp/$lamp.blend" >"$out/$lamp/blender.log" 2>&1
  blender -b "$out/$lamp/$lamp.blend" --python-exit-code 3 -P blender_export/export_aovs.py -- \
    --output "$folder/$lamp.####.exr" --frames 1 --masks "disc:$count" \
    ${truth[@]+"${truth[@]}"} >>"$out/$lamp/blender.log" 2>&1
}

# measure LAMP COUNT: prints the penumbra RMSE.
measure() {
  local lamp=$1 count=$2 folder=$out/$1/$2
  "$kagefude" comp tests/quality/measure.toml "$folder/$lamp.####.exr" -o "$folder/comp.####.exr" \
    --frames 1 --progress none 2>"$out/$lamp/comp.log"
  "$kagefude" compare "$folder/comp.0001.exr" "$out/$lamp/9/$lamp.0001.exr" \
    --channel visibility.Key --against truth.Key --where data.IndexOB --truth-samples $samples \
    --gain 2 --json --picture "$folder/$lamp.0001.error.png" |
    python3 -c 'import json, sys; print("%.3f" % json.load(sys.stdin)["penumbra"]["rmse"])'
}

rows=()
for count in ${COUNTS:-9 17}; do
  row="| $count masks |"
  for lamp in "${lamps[@]}"; do
    [ -n "${KEEP:-}" ] && [ -f "$out/$lamp/$count/$lamp.0001.exr" ] || export_masks "$lamp" $count
    row+=" $(measure "$lamp" $count) |"
  done
  rows+=("$row")
done
printf '| penumbra RMSE |'; printf ' %s |' "${lamps[@]//_/ }"; printf '\n|---|'
printf -- '---|%.0s' "${lamps[@]}"; printf '\n'; printf '%s\n' "${rows[@]}"
