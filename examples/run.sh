#!/usr/bin/env bash
# Installs what is missing, builds, renders the example shot with Blender, comps it, and says which
# pictures to open.   examples/run.sh [--animation] [--walk]   (24 frames of a moving light, of a walking
# character)
set -euo pipefail
cd "$(dirname "$0")/.."
out=examples/out
shots=(still_life)
for argument in "$@"; do
  case $argument in
    --animation) shots+=(moving_light) ;;
    --walk) shots+=(walk) ;;
    *) echo "usage: examples/run.sh [--animation] [--walk]" >&2; exit 2 ;;
  esac
done

.ci/ensure_packages build test render
[ -f build/release/build.ninja ] || cmake --preset release >/dev/null
cmake --build --preset release --target kagefude
kagefude=build/release/kagefude

examples/make_strips.sh "$kagefude" $out/strips >/dev/null

# Prints the frame range of a shot.
frames_of() { [ "$1" = still_life ] && echo 1 || echo 1-24; }
# Prints masks and scale of a shot's export: the walk's hair and grass are thin, and its sun is small.
detail_of() { [ "$1" = walk ] && echo "--masks disc:5 --scale 2" || echo "--masks disc:9"; }

for shot in "${shots[@]}"; do
  folder=$out/$shot
  mkdir -p "$folder"
  # A missing stamp makes find complain, which counts as newer.
  if [ -n "$(find examples/*.py blender_export -name '*.py' -newer "$folder/rendered" 2>&1)" ]; then
    echo "Rendering $shot with Blender ..."
    blender -b --factory-startup --python-exit-code 3 -P "examples/$shot.py" -- \
      "$folder/$shot.blend" >"$folder/blender.log"
    blender -b "$folder/$shot.blend" --python-exit-code 3 -P blender_export/export_aovs.py -- \
      --output "$folder/aovs/$shot.####.exr" --frames "$(frames_of "$shot")" $(detail_of "$shot") \
      2>&1 | tee -a "$folder/blender.log" | sed -n -u '/^Progress:\|^Error/p'
    touch "$folder/rendered"
  fi
  "$kagefude" comp "examples/$shot.toml" "$folder/aovs/$shot.####.exr" \
    -o "$folder/comp/$shot.####.exr" --frames "$(frames_of "$shot")" --preview "$folder/preview"
  "$kagefude" sheet "examples/$shot.toml" "$folder/aovs/$shot.0001.exr" -o "$folder/sheet.png"
done
echo
echo "Open these pictures:"
for shot in "${shots[@]}"; do
  echo "  $out/$shot/preview/$shot.0001.png   the finished frame"
  echo "  $out/$shot/sheet.png                how it came about, step by step"
done
