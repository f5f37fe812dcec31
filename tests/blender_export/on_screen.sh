# Sourced by the tests that want a window: a virtual screen with software OpenGL, the check's scene as
# $work/shot.blend ($inside/shot.blend for Blender), and what they share. $pictures is where they draw.
work=$(mktemp -d "${ROOT:-}/tmp/kagefude-panel-XXXXXX")
inside=${work#"${ROOT:-}"}
source=$PWD
started=()
finish() {
  for process in ${started[@]+"${started[@]}"}; do kill "$process" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap finish EXIT
if [ -n "${ROOT:-}" ]; then
  mkdir -p "$work/source"
  cp -r blender_export tests examples "$work/source/"
  source=$inside/source
fi
blender() {
  if [ -n "${ROOT:-}" ]; then chroot "$ROOT" env HOME=/root LC_ALL=C.UTF-8 "${BLENDER:-blender}" "$@"; else
    command "${BLENDER:-blender}" "$@"
  fi
}
failed=0
fail() { echo "FAILED: $1" >&2; failed=1; }
mkdir -p "$pictures"

export DISPLAY=:${SCREEN_NUMBER:-87} LIBGL_ALWAYS_SOFTWARE=1 PYTHONDONTWRITEBYTECODE=1
Xvfb "$DISPLAY" -screen 0 1100x760x24 +extension GLX >/dev/null 2>&1 &
started+=($!)
sleep 2
blender -b --factory-startup --python-exit-code 1 -P "$source/tests/blender_export/make_check_scene.py" -- \
  "$inside/shot.blend" >"$work/log" 2>&1
before=$(sha256sum <"$work/shot.blend")
# open_window SCRIPT WORD...: starts Blender's window on the scene, with a script of this folder.
open_window() {
  local script=$1
  shift
  blender --factory-startup -p 0 0 1100 760 "$inside/shot.blend" \
    -P "$source/tests/blender_export/$script" -- "$@" >"$work/log" 2>&1 &
  started+=($!)
}
