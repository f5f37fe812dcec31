#!/usr/bin/env bash
# Measures edges: exports the scenes with Blender at one, two and eight times their size (kept in
# build/quality/edges), comps all three, brings the larger ones down in linear light, and prints each
# kind of edge's error against the largest, with pictures side by side. Some minutes a scene.
#   tests/quality/edges.sh [SCENE ...]     pictures: build/quality/edges/SCENE/side_by_side.png
set -euo pipefail
cd "$(dirname "$0")/../.."
out=build/quality/edges
kagefude=${KAGEFUDE:-build/release/kagefude}
blender=${BLENDER:-blender}
scenes=("$@")
[ ${#scenes[@]} -gt 0 ] ||
  scenes=(still_life machine foliage character rim_constant rim_gradient rim_transparent)
[ -x "$kagefude" ] || { echo "build $kagefude first" >&2; exit 2; }
mkdir -p "$out"
examples/make_strips.sh "$kagefude" examples/out/strips >/dev/null

# The scene's file: the example's, a walker of the skin's scenes, or one of edge_scenes.py.
build_scene() {
  local script=tests/quality/edge_scenes.py words=("$1" "$out/$1/$1.blend")
  case $1 in
    still_life) script=examples/still_life.py words=("$out/$1/$1.blend") ;;
    character) script=tests/quality/skin_scenes.py words=(walk "$out/$1/$1.blend") ;;
  esac
  $blender -b --factory-startup --python-exit-code 3 -P $script -- "${words[@]}"
}

# export_at SCENE SCALE: at half the example's size, so that the largest is 4K wide; it needs few
# samples, for 64 of its pixels make one.
export_at() {
  local samples=32
  [ "$2" = 8 ] && samples=2
  $blender -b "$out/$1/$1.blend" --python-exit-code 3 --python-expr "
import bpy
render = bpy.context.scene.render
render.resolution_x, render.resolution_y = 480, 480 * render.resolution_y // render.resolution_x
bpy.context.scene.cycles.samples = $samples" -P blender_export/export_aovs.py -- \
    --output "$out/$1/scale$2/$1.####.exr" --frames 1 --masks disc:9 --depth-size 256 --scale "$2"
}

for scene in "${scenes[@]}"; do
  folder=$out/$scene
  look=tests/quality/edges.toml
  [ "$scene" = still_life ] && look=examples/still_life.toml
  if [ ! -f "$folder/done" ] || [ tests/quality/edge_scenes.py -nt "$folder/done" ]; then
    echo "rendering $scene" >&2
    mkdir -p "$folder"
    { build_scene "$scene"; for scale in 1 2 8; do export_at "$scene" $scale; done; } \
      >"$folder/blender.log" 2>&1
    touch "$folder/done"
  fi
  # The largest is brought down by the table, by two filters.
  for scale in 1 2 8; do
    "$kagefude" comp "$look" "$folder/scale$scale/$scene.0001.exr" -o "$folder/comp$scale.exr" \
      --set output.scale=$((scale == 8 ? 1 : scale)) --set output.colour=float --set 'output.layers=[]' \
      --preview "$folder" --progress none 2>"$folder/comp$scale.log"
  done
done
/usr/bin/python3 tests/quality/edges_table.py "$out" "${scenes[@]}"
