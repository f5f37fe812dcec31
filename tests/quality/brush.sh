#!/usr/bin/env bash
# Measures how still strokes hold in three shots (the light moves; an object turns and moves; the
# camera zooms), for the seed's mapping, polar and held, with two strips: exports the shots with
# Blender (kept in build/quality/brush, made again when brush_scenes.py changes), comps and checks
# them, and prints the table. Exit 1 when a demand is missed.
#   tests/quality/brush.sh [SCENE ...]     plots and contact sheets: build/quality/brush/SCENE
set -euo pipefail
cd "$(dirname "$0")/../.."
out=build/quality/brush
kagefude=${KAGEFUDE:-build/release/kagefude}
frames=1-24
scenes=("$@")
[ ${#scenes[@]} -gt 0 ] || scenes=(orbit turning zoom)
[ -x "$kagefude" ] || { echo "build $kagefude first" >&2; exit 2; }

export_shot() {
  local scene=$1 folder=$out/$1
  [ -f "$folder/aovs/done" ] && [ ! tests/quality/brush_scenes.py -nt "$folder/aovs/done" ] && return
  echo "rendering $scene" >&2
  mkdir -p "$folder"
  blender -b --factory-startup --python-exit-code 3 -P tests/quality/brush_scenes.py -- \
    "$scene" "$folder/$scene.blend" >"$folder/blender.log" 2>&1
  blender -b "$folder/$scene.blend" --python-exit-code 3 -P blender_export/export_aovs.py -- \
    --output "$folder/aovs/$scene.####.exr" --frames $frames --masks disc:5 \
    >>"$folder/blender.log" 2>&1
  touch "$folder/aovs/done"
}

# measure SCENE STRIP METHOD [SETTING ...]
measure() {
  local scene=$1 name=$2_$3 set=(--set "style[0].strip=builtin:$2")
  local folder=$out/$scene/$name
  shift 3
  for setting in "$@"; do set+=(--set "$setting"); done
  "$kagefude" comp tests/quality/brush.toml "$out/$scene/aovs/$scene.####.exr" \
    -o "$folder/$scene.####.exr" --frames $frames --preview "$folder" \
    --progress none "${set[@]}"
  [ "$name" = "${name%_unstyled}" ] || return 0
  "$kagefude" check "$folder/$scene.####.exr" --unstyled "${folder%_*}_unstyled/$scene.####.exr" --aovs "$out/$scene/aovs/$scene.####.exr" \
    --plot "$folder.plot.png" --json >"$folder.json"
  # Every frame, small, for the eye.
  local sheet=(oiiotool) file
  for file in "$folder/$scene".????.png; do sheet+=("$file" --resize 320x180); done
  "${sheet[@]}" --mosaic:pad=4 6x4 -o "$folder.sheet.png"
}

for scene in "${scenes[@]}"; do
  export_shot "$scene"
  for strip in soft fine; do
    measure "$scene" $strip unstyled brush.contrast=0
    measure "$scene" $strip seed brush.mapping=seed
    measure "$scene" $strip polar brush.mapping=polar
    measure "$scene" $strip tone brush.grain=tone
    measure "$scene" $strip held
    if [ "$scene" = zoom ]; then measure "$scene" $strip screen brush.size=screen; fi
  done
done
python3 tests/quality/brush_table.py "$out" "${scenes[@]}"
