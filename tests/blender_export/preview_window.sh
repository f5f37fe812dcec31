#!/usr/bin/env bash
# Presses the panel's Preview and Live in a real Blender window, on a virtual screen with software
# OpenGL: the painted frame must show in an Image Editor, the live page must answer, and end with Blender.
#   tests/blender_export/preview_window.sh [PICTURES]   (build/panel)      BLENDER=command
# By hand, not in CI, as panel_window.sh; it needs the same packages.
set -euo pipefail
cd "$(dirname "$0")/../.."
pictures=${1:-build/panel}
kagefude=$(realpath "${KAGEFUDE:-build/release/kagefude}")
blender=${BLENDER:-blender}
work=$(mktemp -d)
started=()
finish() {
  for process in ${started[@]+"${started[@]}"}; do kill "$process" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap finish EXIT
failed=0
fail() { echo "FAILED: $1" >&2; failed=1; }
mkdir -p "$pictures"

export DISPLAY=:${SCREEN_NUMBER:-88} LIBGL_ALWAYS_SOFTWARE=1 PYTHONDONTWRITEBYTECODE=1
Xvfb "$DISPLAY" -screen 0 1100x760x24 +extension GLX >/dev/null 2>&1 &
started+=($!)
sleep 2
$blender -b --factory-startup --python-exit-code 1 -P tests/blender_export/make_check_scene.py -- \
  "$work/shot.blend" >"$work/log" 2>&1
before=$(sha256sum <"$work/shot.blend")
printf 'kagefude = 1\n' >"$work/look.toml"
$blender --factory-startup -p 0 0 1100 760 "$work/shot.blend" \
  -P tests/blender_export/preview_window.py -- "$kagefude" "$work/look.toml" "$work/state.json" >"$work/log" 2>&1 &
window=$!
started+=($window)

value() { python3 -c "import json, sys; print(json.load(open('$work/state.json')).get(sys.argv[1]))" "$1"; }
reached() { [ "$(value step 2>/dev/null)" = "$1" ]; }
wait_for() {
  local i
  for ((i = 0; i < 480; i++)); do
    if reached "$1" || reached done; then return; fi
    sleep 0.25
  done
  fail "it never came to '$1'"
}
wait_for shown
sleep 2
import -window root "$pictures/preview.png"
[ "$(value size)" != None ] || fail "no Image Editor shows the preview"
wait_for lived
[ "$(value process)" != None ] || fail "the live page does not run"
page=$(value process)
import -window root "$pictures/live.png"
[ "$before" = "$(sha256sum <"$work/shot.blend")" ] || fail "the file on disk was changed"
touch "$work/state.json.quit"
for _ in $(seq 80); do kill -0 "$window" 2>/dev/null || break; sleep 0.25; done
! kill -0 "$window" 2>/dev/null || fail "Blender does not end"
! kill -0 "$page" 2>/dev/null || { fail "the live page runs on after Blender"; kill "$page"; }
[ $failed -eq 0 ] && echo "Preview and Live work ($(value size) pixels); look at the pictures in $pictures" ||
  { tail -n 15 "$work/log"; exit 1; }
