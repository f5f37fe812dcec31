#!/usr/bin/env bash
# Drives the add-on's panel in a real Blender window, on a virtual screen with software OpenGL: opens
# and fills it, presses Export, sees progress, an error and a finished export, and cancels one.
#   tests/blender_export/panel_window.sh [PICTURES]   (build/panel)   BLENDER=command  ROOT=folder
# By hand, not in CI: software OpenGL takes a minute to start, and the pictures want to be looked at.
# Needs xvfb, xdotool, imagemagick and libgl1-mesa-dri. With ROOT, such as one that blender_versions.sh
# made, Blender runs inside that root, which needs libegl1 and libgl1-mesa-dri too.
set -euo pipefail
cd "$(dirname "$0")/../.."
pictures=${1:-build/panel}
source tests/blender_export/on_screen.sh
open_window panel_window.py "$inside/state.json"

# value KEY: of the state that the window writes five times a second.
value() { python3 -c "import json, sys; print(json.load(open('$work/state.json'))[sys.argv[1]])" "$1"; }
# until_true MESSAGE TEST...: waits at most two minutes.
until_true() {
  local message=$1 i
  shift
  for ((i = 0; i < 480; i++)); do
    "$@" 2>/dev/null && return
    sleep 0.25
  done
  fail "$message"
}
is() { [ "$(value "$1")" = "$2" ]; }
said() { [[ $(value said) == *"$1"* ]]; }
moving() { [ "$(value percent)" -gt 0 ]; }
picture() { seen; sleep 2; import -window root "$pictures/$1.png"; }
# Waits until Blender has gone round its loop a few times, and so has seen what was done.
seen() {
  local wanted=$(($(value ticks) + 4))
  while [ "$(value ticks)" -lt $wanted ]; do sleep 0.2; done
}
move() { xdotool mousemove "$1" "$2"; seen; }
press() { # press BUTTON
  xdotool mousedown "$1"; seen
  xdotool mouseup "$1"; seen
}
click() { move "$1" "$2"; press 1; }
# turn X Y STEPS [BUTTON]: the next choices of a menu, with the control key and the mouse's wheel.
turn() {
  move "$1" "$2"
  xdotool keydown ctrl; seen
  for _ in $(seq "$3"); do xdotool click "${4:-5}"; seen; done
  xdotool keyup ctrl; seen
}
# Moves the mouse away from an error's message; in Blender 5 that of a finished export stays until Escape.
close_message() { move $middle 600; xdotool key Escape; seen; }
write() { # write X Y TEXT
  move "$1" "$2"
  xdotool click --repeat 2 --delay 120 1; seen
  xdotool key ctrl+a; seen
  xdotool type "$3"; seen
  xdotool key Return; seen
}

until_true "the window never opened" test -f "$work/state.json"
# Without a window manager nothing gives the window the keyboard, and Blender 5 then heeds no mouse.
xdotool windowfocus "$(xdotool search --onlyvisible --name . | head -n 1)"
# A Blender that was never started before asks for its set-up.
xdotool key Escape
seen
left=$(value left) top=$(value top) middle=$(($(value left) + 610))
# The height of a line of the open panel, by its distance from the first: 23 is "Masks", 95 "Frames",
# 118 their list, 187 the depth maps' size, 262 the button.
row() { echo $((top + 83 + $1)); }
picture 1_closed
# The first presses may only wake the window.
for _ in 1 2 3 4 5; do
  click $((left + 50)) $((top + 53))
  ! is opened True || break
done
is opened True || fail "the panel cannot be opened"
picture 2_opened
turn $middle "$(row 23)" 3
until_true "the masks cannot be chosen" is masks disc:5
turn $middle "$(row 95)" 2
until_true "a list of frames cannot be chosen" is frames LIST
write $middle "$(row 187)" 64
write $middle "$(row 118)" "2,two"
until_true "the frames cannot be written" is frame_list 2,two
picture 3_filled_in
click $middle "$(row 262)"
picture 4_wrong_frames
[ "$(value percent)" = -1 ] || fail "a wrong range of frames was exported"
close_message
write $middle "$(row 118)" 1-40
until_true "the frames cannot be mended" is frame_list 1-40
click $middle "$(row 262)"
until_true "the export does not get on" moving
picture 5_under_way
click $middle "$(row 262)"
until_true "the export cannot be cancelled" is ended 1
said "Export cancelled" || fail "it is not said that the export was cancelled"
picture 6_cancelled
[ -z "$(find "$work/kagefude" -name '.*' 2>/dev/null)" ] || fail "a cancelled export left unfinished files"
[ ! -e "$work/kagefude/shot.0040.json" ] || fail "the export ran on"
[ "$(value dirty)" = True ] || fail "the export hid that the open file has unsaved changes"
rm -rf "$work/kagefude"  # frames that were done before it was cancelled
turn $middle "$(row 23)" 2
write $middle "$(row 118)" 2
until_true "the frames cannot be written again" is frame_list 2
click $middle "$(row 262)"
until_true "a pair of masks was not tried" is started 2
until_true "an export that fails does not end" is ended 2
picture 7_failed
said "light 'Sun' is a sun" || fail "it is not said why the export failed"
[ ! -e "$work/kagefude/shot.0002.json" ] || fail "a pair of masks was made of a sun"
close_message
turn $middle "$(row 23)" 2 4
until_true "the masks cannot be mended" is masks disc:5
click $middle "$(row 262)"
until_true "the export does not end" is ended 3
said "Exported to" || fail "the export failed: $(value said)"
[ -e "$work/kagefude/shot.0002.json" ] || fail "the export wrote nothing"
picture 8_finished
[ "$before" = "$(sha256sum <"$work/shot.blend")" ] || fail "the file on disk was changed"
[ $failed -eq 0 ] && echo "The panel works; look at the pictures in $pictures" || { tail -n 5 "$work/log"; exit 1; }
