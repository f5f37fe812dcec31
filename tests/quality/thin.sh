#!/usr/bin/env bash
# What comes out of hair, cut leaves, see-through things, volumes and glass: exports a scene with Blender,
# comps it and lays the comp over the beauty.   tests/quality/thin.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
out=build/quality/thin
kagefude=${KAGEFUDE:-build/release/kagefude}
blender=${BLENDER:-blender}
[ -x "$kagefude" ] || { echo "build $kagefude first" >&2; exit 2; }
mkdir -p "$out"
$blender -b --factory-startup --python-exit-code 3 -P tests/quality/thin_scene.py -- "$out/thin.blend" >"$out/log"
$blender -b "$out/thin.blend" --python-exit-code 3 -P blender_export/export_aovs.py -- \
  --output "$out/aovs/thin.####.exr" --frames 1 --masks disc:5 --scale 2 >>"$out/log" 2>&1
grep '^note' "$out/log"
cat >"$out/look.toml" <<'LOOK'
kagefude = 1
[output]
scale = 2
[[style]]
object = "*"
strip = "builtin:soft"
colour = "multiply"
tone.gamma = 1.6
LOOK
"$kagefude" comp "$out/look.toml" "$out/aovs/thin.####.exr" -o "$out/comp/thin.####.exr" --preview "$out"
oiiotool "$out/aovs/thin.0001.exr" --ch beauty.Combined.R,beauty.Combined.G,beauty.Combined.B --resize:filter=box 50% \
  --colorconvert linear sRGB -d uint8 -o "$out/beauty.png" "$out/thin.0001.png" "$out/beauty.png" --mosaic 1x2 -o "$out/thin.png"
echo "$out/thin.png"
