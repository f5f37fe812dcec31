#!/usr/bin/env bash
# Presses the panel's Preview and Live in a real Blender window, on a virtual screen with software
# OpenGL: the painted frame must show in an Image Editor, the live page must run, and end with Blender.
#   tests/blender_export/preview_window.sh [PICTURES]   (build/panel)   BLENDER=command  ROOT=folder
#                                                                      END=quit|kill
# With END=kill Blender is killed, as a crash ends it, and the page must still end.
# By hand, not in CI, as panel_window.sh; it needs the same packages.
set -euo pipefail
cd "$(dirname "$0")/../.."
pictures=${1:-build/panel}
kagefude=$(realpath "${KAGEFUDE:-build/release/kagefude}")
source tests/blender_export/on_screen.sh
printf 'kagefude = 1\n' >"$work/look.toml"
# Another system's Blender starts the programs with this one's libraries.
if [ -n "${ROOT:-}" ]; then
  place=$work/program
  mkdir -p "$place/bin"
  files=("$kagefude" "$(dirname "$kagefude")/kagefude-oiio" \
    "$(ldconfig -p | awk '/libmicrohttpd.so.12 /{found = $NF} END{print found}')")
  cp "${files[@]}" "$place/bin/"
  ldd "${files[@]}" | awk '/=> \//{print $3} /^\t\/.*ld-linux/{print $1}' | sort -u | xargs cp -t "$place"
  for name in kagefude kagefude-oiio; do
    printf '#!/bin/sh\nexec %s/ld-linux-x86-64.so.2 --library-path %s:%s/bin %s/bin/%s "$@"\n' \
      "$inside/program" "$inside/program" "$inside/program" "$inside/program" $name >"$place/$name"
    chmod +x "$place/$name"
  done
  kagefude=$inside/program/kagefude
fi
open_window preview_window.py "$kagefude" "$inside/look.toml" "$inside/state.json"
window=${started[-1]}

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
if [ "${END:-quit}" = kill ]; then kill -KILL "$(ps -o ppid= -p "$page")"; else touch "$work/state.json.quit"; fi
for _ in $(seq 80); do kill -0 "$window" 2>/dev/null || break; sleep 0.25; done
! kill -0 "$window" 2>/dev/null || fail "Blender does not end"
# Nobody may have waited for what a killed one has started: a zombie has ended too.
ended() { case $(ps -o stat= -p "$1") in '' | Z*) true ;; *) false ;; esac; }
for _ in $(seq 20); do ended "$page" && break || sleep 0.25; done
ended "$page" || { fail "the live page runs on after Blender"; kill "$page"; }
[ $failed -eq 0 ] && echo "Preview and Live work ($(value size) pixels); look at the pictures in $pictures" ||
  { tail -n 15 "$work/log"; exit 1; }
