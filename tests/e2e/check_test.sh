#!/usr/bin/env bash
# kagefude check on sequences whose error is known: a picture that stands still, one that brightens,
# and one that moves with its vectors; clear errors for what is missing.
set -euo pipefail
source "$(dirname "$0")/frames.sh"

# The still life three times: its motion vectors say that it stood still.
mkdir -p "$work/in" "$work/out" "$work/bright"
for frame in 1 2 3; do
  cp "$data/shot.0001.exr" "$work/in/shot.000$frame.exr"
  sed "s/shot.0001.exr/shot.000$frame.exr/; s/\"frame\": 1,/\"frame\": $frame,/" "$data/shot.0001.json" \
    >"$work/in/shot.000$frame.json"
done
cp "$data/shot.Key.depth.0001.exr" "$work/in/"
printf '[output]\nlayers = ["brush.tone"]\ncolour = "float"\nbackground = "transparent"\n' >"$work/look.toml"
"$kagefude" comp "$work/look.toml" "$work/in/shot.####.exr" -o "$work/out/shot.####.exr" --frames 1-3 --progress none
check_json() { "$kagefude" check "$@" --aovs "$work/in/shot.####.exr" --json; }
value() { python3 -c 'import json, sys
place = json.load(sys.stdin)
for key in sys.argv[1].split("."): place = place[key]
print(place)' "$1"; }
within() { python3 -c "import sys; sys.exit(not abs($1 - $2) <= $3)"; }

still=$(check_json "$work/out/shot.####.exr" | value warp_error.picture)
check "a picture that stands still has a warp error of $still" within "$still" 0 1e-6

# Frame 2 and 3 are brighter by 0.1 and 0.2 all over: every step is 0.1.
for frame in 1 2 3; do
  oiiotool "$work/out/shot.000$frame.exr" --addc "0.$((frame - 1)),0.$((frame - 1)),0.$((frame - 1)),0,0" \
    -o "$work/bright/shot.000$frame.exr"
done
bright=$(check_json "$work/bright/shot.####.exr" --plot "$work/plot.png" --write-json "$work/check.json")
check "brightening by 0.1 is not measured as such" within "$(value warp_error.picture <<<"$bright")" 0.1 1e-5
check "even steps are no jump" within "$(value jump.largest_to_median <<<"$bright")" 1 1e-4
check "the written JSON is not the printed one" diff -q <(echo "$bright") "$work/check.json"
check "the plot is no picture" grep -qE '960 +x +780' <(iinfo "$work/plot.png")
fields=$(python3 -c 'import json, sys
first = json.load(sys.stdin)["objects"][0]
print(first["name"] != "", first["pixels"] > 0, first["ratio"] > 0, first["worst_frame"] in (2, 3))' <<<"$bright")
check "objects are not measured: $fields" test "$fields" = "True True True True"
check "an object's worst frame is not printed" grep -qE 'strokes of [^:]+: change 0.*; worst frame [23] \([0-9.]+\), there most at pixel [0-9]+,[0-9]+' \
  <("$kagefude" check "$work/bright/shot.####.exr" --aovs "$work/in/shot.####.exr" --moves "$work/moves.png")
check "the picture of moves is no picture of the frame's size" \
  test "$(iinfo "$work/moves.png" | grep -oE '[0-9]+ +x +[0-9]+')" = "$(iinfo "$work/in/shot.0001.exr" | grep -oE '[0-9]+ +x +[0-9]+')"
check "moves go to another kind of file" grep -q 'moves.*\.png' \
  <("$kagefude" check "$work/bright/shot.####.exr" --aovs "$work/in/shot.####.exr" --moves "$work/moves.jpg" 2>&1)
same=$(check_json "$work/bright/shot.####.exr" --unstyled "$work/bright/shot.####.exr")
check "against itself there is excess" within "$(value warp_error.excess <<<"$same")" 0 1e-9

# Most frames do not change at all: the one that does is named, though the median is 0.
mkdir -p "$work/step"
for frame in 1 2; do oiiotool "$work/out/shot.000$frame.exr" --mulc 0,0,0,1,1 -o "$work/step/shot.000$frame.exr"; done
oiiotool "$work/step/shot.0002.exr" --addc 0.1,0.1,0.1,0,0 -o "$work/step/shot.0003.exr"
for frame in 4 5; do
  cp "$work/in/shot.0003.exr" "$work/in/shot.000$frame.exr"
  sed "s/shot.0003.exr/shot.000$frame.exr/; s/\"frame\": 3,/\"frame\": $frame,/" "$work/in/shot.0003.json" \
    >"$work/in/shot.000$frame.json"
  cp "$work/step/shot.0003.exr" "$work/step/shot.000$frame.exr"
done
check "the only frame that changes is not named" \
  grep -qF 'largest jump: at frame 3;' <("$kagefude" check "$work/step/shot.####.exr" --aovs "$work/in/shot.####.exr")

# A frame whose JSON was written by what it shows is named, unless the look says how large the scene is.
sed -i 's/"radius": 3.49[0-9]*/"radius": 12.5/' "$work/in/shot.0004.json" "$work/in/shot.0005.json"
breaks() { "$kagefude" check "$work/step/shot.####.exr" --aovs "$work/in/shot.####.exr" "$@" | grep '^warning' || true; }
check "the frame in which the subject grows is not named" \
  grep -q '^warning: frame 4: the radius of what light Key lights goes from 3.49[0-9]* to 12.5' <(breaks)
check "a scene in the look does not settle it" test -z "$(breaks --set 'scene.centre=[0,0,1]' --set scene.radius=3)"
rm "$work"/in/shot.000[45].*

# Errors are one line that names what is missing.
complain() { # complain WORDS CODE ARGUMENT...
  local words=$1 code=$2
  shift 2
  [ "$(exit_code "$kagefude" check "$@")" = "$code" ] && grep -qF -- "$words" "$work/log" && pass ||
    fail "expected '$words', got: $(cat "$work/log")"
}
rm "$work/bright/shot.0002.exr"
complain 'frame 2: ' 1 "$work/bright/shot.####.exr" --aovs "$work/in/shot.####.exr" --frames 1-3
complain 'frame 3 does not follow frame 1' 2 "$work/bright/shot.####.exr" --aovs "$work/in/shot.####.exr"
complain 'has no layer brush.tine' 1 "$work/out/shot.####.exr" --aovs "$work/in/shot.####.exr" --tone brush.tine
complain 'at least two are compared' 2 "$work/out/shot.####.exr" --aovs "$work/in/shot.####.exr" --frames 2
complain 'a sequence is wanted' 2 "$work/out/shot.0001.exr"
complain 'data.Motion' 1 "$work/out/shot.####.exr" --aovs "$work/in/shot.####.exr" --set frame.vector=data.Motion
summary
