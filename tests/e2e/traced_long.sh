#!/usr/bin/env bash
# A shadow that Blender traced in place of masks reaches the comp as it is.
set -euo pipefail
cd "$(dirname "$0")/../.."
kagefude=$PWD/build/release/kagefude
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

blender -b --factory-startup --python-exit-code 3 -P tests/quality/scenes.py -- \
  ball_and_box "$work/shot.blend" >"$work/log.txt" 2>&1 || fail "$(tail -5 "$work/log.txt")"
blender -b "$work/shot.blend" --python-exit-code 3 -P blender_export/export_aovs.py -- \
  --output "$work/s.####.exr" --frames 1 --masks trace:8 --depth-size 16 \
  >"$work/log.txt" 2>&1 || fail "$(tail -5 "$work/log.txt")"
"$kagefude" comp tests/quality/measure.toml "$work/s.0001.exr" -o "$work/comp.exr" --progress none
rmse=$("$kagefude" compare "$work/comp.exr" "$work/s.0001.exr" --channel visibility.Key \
  --against traced.Key --where data.IndexOB --json |
  python3 -c 'import json, sys; print(json.load(sys.stdin)["rmse"])')
python3 -c "import sys; sys.exit(not float('$rmse') < 1e-6)" || fail "visibility differs by $rmse"

code=0
"$kagefude" comp tests/quality/measure.toml "$work/s.0001.exr" -o "$work/comp.exr" \
  --set shadow.method=disc --progress none 2>"$work/err.txt" || code=$?
[ "$code" -ne 0 ] || fail "a disc without masks must be an error"
grep -q -- '--masks disc:9' "$work/err.txt" || fail "$(cat "$work/err.txt")"
echo "traced shadows reach the comp"
