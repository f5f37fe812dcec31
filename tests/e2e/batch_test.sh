#!/usr/bin/env bash
# Sequences: every way to cut a run gives the same files; what is stale is made anew and nothing else;
# bad frames, full disks, closed folders and signals end as they should, with nothing partial left.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/frames.sh"

make_frames "$work/in" 24
oiiotool --pattern fill:topleft=0.1,0.1,0.3:topright=0.1,0.1,0.3:bottomleft=1,0.9,0.8:bottomright=1,0.9,0.8 64x64 3 -d uint8 -o "$work/strip.png"
cp src/colour/config.ocio "$work/config.ocio"
cat >"$work/look.toml" <<'LOOK'
[output]
layers = ["visibility.*", "brush.tone"]
[colour]
config = "config.ocio"
[[style]]
object = "*"
strip = "strip.png"
LOOK
comp() { # comp OUTPUT-FOLDER OPTIONS...
  "$kagefude" comp "$work/look.toml" "$work/in/shot.####.exr" -o "$work/$1/shot.####.exr" --progress plain "${@:2}"
}

# One run, single runs, chunks, thread counts and memory bounds: byte for byte the same files.
comp whole --frames 1-24 >"$work/log" 2>&1
check "24 files" test "$(ls "$work/whole" | wc -l)" -eq 24
for i in $(seq 24); do
  "$kagefude" comp "$work/look.toml" "$work/in/shot.$(printf %04d "$i").exr" \
    -o "$work/single/shot.$(printf %04d "$i").exr" --progress none >"$work/log" 2>&1
done
check "single runs differ" same_files "$work/whole" "$work/single"
for parts in 2 5 24; do
  for i in $(seq "$parts"); do comp "chunks$parts" --chunk "$i/$parts" >"$work/log" 2>&1; done
  check "$parts chunks differ" same_files "$work/whole" "$work/chunks$parts"
done
comp one --threads 1 >"$work/log" 2>&1
check "one thread differs" same_files "$work/whole" "$work/one"
comp alone --frames 24-1 --frames-at-once 1 --max-memory 64M >"$work/log" 2>&1
check "backwards, one at a time differs" same_files "$work/whole" "$work/alone"

# --existing: what decides a frame's pixels is in its fingerprint.
made() { comp up --existing update --preview "$work/preview" "$@" 2>&1 | tail -1 || true; }
expect_made() { # expect_made TEXT WHY [OPTIONS...]
  local text
  text=$(made "${@:3}")
  check "$2: expected \"$1\", got \"$text\"" test "$text" = "$1"
}
expect_made "24 frames done" "first"
expect_made "0 frames done, 24 kept" "nothing changed"
expect_made "24 frames done" "another value of the look" --set smooth.h=3
expect_made "24 frames done" "back again"
sed -i 's/"energy": 1900.0/"energy": 1901.0/' "$work/in/shot.0003.json"
expect_made "1 frame done, 23 kept" "a sidecar changed"
sed -i 's/"energy": 1901.0/"energy": 1900.0/' "$work/in/shot.0003.json"
oiiotool "$work/in/shot.0005.exr" --mulc 1.01 -o "$work/other.exr" && mv "$work/other.exr" "$work/in/shot.0005.exr"
expect_made "2 frames done, 22 kept" "a sidecar and an input changed"
oiiotool "$work/strip.png" --flop --mulc 0.5 -d uint8 -o "$work/new.png" && mv "$work/new.png" "$work/strip.png"
expect_made "24 frames done" "a strip changed"
echo '# a remark' >>"$work/config.ocio"
expect_made "24 frames done" "the colour configuration changed"
oiiotool "$work/in/shot.Key.depth.0001.exr" --mulc 1.5 -o "$work/other.exr" && mv "$work/other.exr" "$work/in/shot.Key.depth.0001.exr"
expect_made "24 frames done" "a depth map changed"
rm "$work/up/shot.0007.exr"
expect_made "1 frame done, 23 kept" "an output is gone"
head -c 3000 "$work/up/shot.0008.exr" >"$work/cut" && cp "$work/cut" "$work/up/shot.0008.exr"
: >"$work/up/shot.0009.exr"
expect_made "2 frames done, 22 kept" "an output is cut, another empty"
comp up --set smooth.h=4 >"$work/log" 2>&1
expect_made "24 frames done" "a preview of another look" --set smooth.h=4
text=$(comp up --existing skip 2>&1 | tail -1 || true)
check "skip keeps whatever is there: $text" test "$text" = "0 frames done, 24 kept"
comp whole >"$work/log" 2>&1

# A report per chunk, and one of the whole from what is there.
comp whole --existing update --chunk 2/3 --report "$work/report" >"$work/log" 2>&1
check "a chunk's report" test -s "$work/report/chunk-2-of-3/index.html"
comp whole --existing update --report "$work/report" >"$work/log" 2>&1
check "24 thumbnails" test "$(ls "$work/report/thumbs" | wc -l)" -eq 24
check "the report calls no other host" bash -c "! grep -Eq '(src|href)=\"?(https?:)?//' '$work/report/index.html'"

# Views.
mkdir -p "$work/views"
for view in left right; do
  cp "$work/in/shot.0001.exr" "$work/views/$view.0001.exr"
  sed "s/shot.0001.exr/$view.0001.exr/" "$work/in/shot.0001.json" >"$work/views/$view.0001.json"
done
cp "$work/in/shot.Key.depth.0001.exr" "$work/views/"
"$kagefude" comp "$work/look.toml" "$work/views/%V.####.exr" -o "$work/out/%V/shot.####.exr" --views left,right >"$work/log" 2>&1
check "both views" test -s "$work/out/left/shot.0001.exr" -a -s "$work/out/right/shot.0001.exr"
check "views need a place" test "$(exit_code "$kagefude" comp "$work/look.toml" "$work/views/%V.####.exr" -o "$work/out/shot.####.exr" --views left,right)" -eq 2

# Bad frames.
cp -r "$work/in" "$work/bad"
head -c 20000 "$work/in/shot.0004.exr" >"$work/bad/shot.0004.exr"
rm "$work/bad/shot.0006.exr"
bad() { "$kagefude" comp "$work/look.toml" "$work/bad/shot.####.exr" -o "$work/$1/shot.####.exr" --frames 1-24 --progress plain "${@:2}"; }
check "a missing frame is an error" test "$(exit_code bad bad1)" -eq 1
check "and is named: $(cat "$work/log")" grep -q "ERROR: .*6" "$work/log"
check "nothing was touched" test ! -e "$work/bad1"
check "bad frames: exit 1" test "$(exit_code bad bad2 --skip-bad-frames)" -eq 1
check "frame 4 named" grep -q "^ERROR: frame 4: .*shot.0004.exr" "$work/log"
check "frame 6 named" grep -q "^ERROR: frame 6: .*shot.0006.exr" "$work/log"
check "the summary" grep -q "^22 frames done, 2 failed" "$work/log"
rm -f "$work/bad2/shot.0004.exr"
cp -r "$work/whole" "$work/now"
rm "$work/whole/shot.0004.exr" "$work/whole/shot.0006.exr"
check "the good frames" same_files "$work/whole" "$work/bad2"

# What cannot be written is one clear error; finished frames stay.
code=$(ulimit -f 4 && exit_code comp limited --threads 1)
check "a size limit: exit $code" test "$code" -eq 1
check "one error: $(cat "$work/log")" test "$(grep -c "^ERROR: .*File too large" "$work/log")" -eq 1
check "nothing is left of it" test -z "$(find "$work/limited" -type f)"
if [ "$(id -u)" -eq 0 ] && mkdir "$work/small" && mount -t tmpfs -o size=150k tmpfs "$work/small" 2>/dev/null; then
  code=$(exit_code comp small --threads 1)
  check "a full disk: exit $code" test "$code" -eq 1
  check "one error: $(cat "$work/log")" test "$(grep -c "^ERROR: .*No space left" "$work/log")" -eq 1
  count=$(ls "$work/small" | wc -l)
  check "finished frames stay: $count" test "$count" -ge 2
  for file in "$work/small"/*; do
    check "$file is whole" cmp -s "$file" "$work/now/$(basename "$file")"
  done
  check "nothing hidden stays" test -z "$(find "$work/small" -name '.*' -type f)"
  umount "$work/small"
else
  echo "skipped: a full disk (needs root and tmpfs)"
fi
mkdir "$work/closed"
chmod 755 "$work"
chmod 555 "$work/closed"
as_user=()
[ "$(id -u)" -ne 0 ] || as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
code=$(exit_code "${as_user[@]}" "$kagefude" comp "$work/look.toml" "$work/in/shot.####.exr" -o "$work/closed/shot.####.exr" --progress none)
check "a closed folder: exit $code, $(cat "$work/log")" test "$code" -eq 1
check "is named once" test "$(grep -c "^ERROR: .*closed.*Permission denied" "$work/log")" -eq 1

# Signals, in a run that would take minutes.
mkdir "$work/long"
cp "$data/shot.Key.depth.0001.exr" "$work/long/"
for i in $(seq 1000 2000); do
  ln -s "$data/shot.0001.exr" "$work/long/shot.$i.exr"
  ln -s "$data/shot.0001.json" "$work/long/shot.$i.json"
done
# The last: one picture so large that no stage of it ends within the two seconds.
oiiotool "$data/shot.0001.exr" --resample 4096x2304 -o "$work/large.exr"
cp "$data/shot.0001.json" "$work/large.json"
cp "$data/shot.Key.depth.0001.exr" "$work/"
interrupted() { # interrupted CODE SIGNAL TIMES INPUT OUTPUT
  local code=0 begin end process
  rm -rf "$work/stopped"
  "$kagefude" comp "$work/look.toml" "$work/$4" -o "$work/stopped/$5" --threads 1 >"$work/log" 2>&1 &
  process=$!
  sleep 0.7
  begin=$(date +%s%N)
  for _ in $(seq "$3"); do
    kill "-$2" "$process" 2>/dev/null || true
    sleep 0.05
  done
  wait "$process" || code=$?
  end=$(date +%s%N)
  check "SIG$2 x $3 on $4: exit $code instead of $1" test "$code" -eq "$1"
  check "SIG$2 x $3 on $4: $(((end - begin) / 1000000)) ms" test $(((end - begin) / 1000000)) -lt 2000
  check "SIG$2 x $3 on $4 left something" test -z "$(find "$work/stopped" -name '.*' -type f 2>/dev/null)"
  for file in $(find "$work/stopped" -name "shot*" 2>/dev/null); do
    check "$file is whole" oiiotool "$file" --stats -o "$work/null.exr" >/dev/null
  done
}
interrupted 130 INT 1 'long/shot.####.exr' 'shot.####.exr'
interrupted 143 TERM 1 'long/shot.####.exr' 'shot.####.exr'
interrupted 143 TERM 2 'long/shot.####.exr' 'shot.####.exr'
interrupted 130 INT 1 large.exr large.exr
interrupted 143 TERM 2 large.exr large.exr
check "no part of the large frame" test ! -e "$work/stopped/large.exr"
summary
