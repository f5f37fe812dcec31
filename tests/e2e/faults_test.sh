#!/usr/bin/env bash
# Lost or spoiled without a word, hostile and huge: whatever a run meets, it says so in one sentence
# and an exit code, and nothing that it read or wrote is harmed.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/frames.sh"

make_frames "$work/in" 3
cd "$work"
cat >look.toml <<'LOOK'
[[style]]
object = "*"
strip = "builtin:soft"
LOOK
run() { timeout 60 "$kagefude" "$@"; }
expect() { # expect CODE TEXT ARGUMENTS...: the exit code, and a text in the log ("" for any)
  local code
  code=$(exit_code run "${@:3}")
  check "${*:3}: exit $code instead of $1: $(head -c 300 log)" test "$code" -eq "$1"
  [ -z "$2" ] || check "${*:3}: no \"$2\" in: $(head -c 300 log)" grep -qF -- "$2" log
}
comp1() { echo comp look.toml in/shot.0001.exr -o "$1"; }

# Standard descriptors that are closed: nothing printed lands in a frame.
run comp look.toml 'in/shot.####.exr' -o 'open/shot.####.exr' --set output.compression=none >log 2>&1
for closed in '0<&- 1>&- 2>&-' '2>&-' '1>&- 2>&-'; do
  for round in 1 2 3; do
    rm -rf closed
    code=0
    eval "\"$kagefude\" comp look.toml 'in/shot.####.exr' -o 'closed/shot.####.exr' --threads 8 \
      --set output.compression=none $closed" || code=$?
    check "closed $closed: exit $code" test "$code" -eq 0
    check "closed $closed: other frames" same_files open closed
  done
done

# An output folder that goes away while the run goes on: what is lost is named, not counted as done.
mkdir many
for i in $(seq 40); do
  cp in/shot.0001.exr "$(printf 'many/m.%04d.exr' "$i")"
  cp in/shot.0001.json "$(printf 'many/m.%04d.json' "$i")"
done
# It goes in one step: a removal file by file could end after the run, and take what the run had
# counted by then.
( until [ -f gone/m.0004.exr ]; do :; done; mv gone away ) &
watcher=$!
code=$(exit_code run comp look.toml 'many/m.####.exr' -o 'gone/m.####.exr' --threads 1 --progress plain --skip-bad-frames)
wait "$watcher"
there=$({ find gone -name "m.*" 2>/dev/null || true; } | wc -l)
check "a folder removed: exit $code" test "$code" -eq 1
check "a folder removed: $there there, said: $(tail -2 log)" grep -qE "^$there frames? done,( [0-9]+ failed,)? [1-9][0-9]* lost" log
check "a folder removed: no ERROR line" grep -q '^ERROR: frames .* not on the disk any more' log

# Files that are read are never written, whatever they are called; suffixes mean what they say.
cp in/shot.0001.exr one.exr
cp in/shot.0001.json one.json
cp in/shot.Key.depth.0001.exr .
mkdir strips
run strip make strips/one.png >log
printf '[[style]]\nobject = "*"\nstrip = "strips/one.png"\n' >strip.toml
ln one.exr hard.exr
ln -s one.exr soft.exr
before=$(cat one.exr one.json look.toml strips/one.png shot.Key.depth.0001.exr | md5sum)
for output in one.exr hard.exr soft.exr ./strips/../one.exr; do
  expect 2 "would overwrite" comp look.toml one.exr -o "$output"
done
expect 2 "would overwrite" comp look.toml one.exr -o shot.Key.depth.0001.exr
expect 2 "would overwrite" comp strip.toml one.exr -o out/one.exr --preview strips
ln one.exr picture.png
expect 2 "would overwrite" compare one.exr one.exr --channel data.Depth --picture picture.png
ln strips/one.png sheet.png
expect 2 "would overwrite" sheet strip.toml one.exr -o sheet.png
expect 2 "no pictures are written as .toml" comp look.toml one.exr -o look.toml
expect 2 "did you mean .png?" comp look.toml one.exr -o x.pngg
expect 2 "no suffix" comp look.toml one.exr -o x
expect 2 "hold uint8" comp look.toml one.exr -o x.jpg --set output.colour=half
expect 2 "display-ready" comp look.toml one.exr -o x.exr --preview strips --preview-format exr
expect 2 "no pictures are written as .gif" comp look.toml one.exr -o x.exr --preview strips --preview-format gif
expect 2 "should end in .png" sheet look.toml one.exr -o x.exr
expect 2 "should end in .png" strip make x.tif
expect 2 "should end in .exr" bench --save x.png
expect 2 "" comp look.toml one.exr -o /dev/stdout
check "something that is read was written" \
  test "$before" = "$(cat one.exr one.json look.toml strips/one.png shot.Key.depth.0001.exr | md5sum)"

# Not plain files.
mkfifo pipe
mkdir folder
for look in folder /dev/zero pipe; do expect 2 "the look" comp "$look" one.exr -o x.exr; done
expect 0 "" comp /dev/null one.exr -o x.exr
cp one.exr two.exr
mkfifo two.json
expect 1 "a pipe" comp look.toml two.exr -o x.exr
expect 1 "a pipe" inspect pipe
expect 1 "" strip check pipe
expect 1 "a folder" inspect folder
for option in --frames --chunk --preview --report --max-memory; do
  expect 2 "empty" comp look.toml one.exr -o x.exr "$option" ''
done

# inspect: a frame that is wrong is no success, what is only missing is one; maps are looked at.
cp "$data/shot.0001.exr" whole.exr
expect 0 "there is no JSON beside the frame" inspect whole.exr
echo '{"kagefude": 1' >whole.json
expect 1 "whole.json is not valid JSON" inspect whole.exr
check "inspect: no ERROR line" grep -q '^ERROR: whole.exr cannot be used as it is: ' log
expect 1 '"findings"' inspect whole.exr --json
sed 's/shot.Key.depth.0001.exr/whole.depth.exr/' "$data/shot.0001.json" >whole.json
head -c 300 "$data/shot.Key.depth.0001.exr" >whole.depth.exr
expect 1 "whole.depth.exr" inspect whole.exr
oiiotool "$data/shot.Key.depth.0001.exr" --rotate180 -o whole.depth.exr
expect 0 "warning: the depth map of light Key" inspect whole.exr
expect 0 "does not fit its masks" inspect whole.exr --json
expect 0 "set aside" comp look.toml whole.exr -o x.exr
cp "$data/shot.Key.depth.0001.exr" whole.depth.exr
expect 0 "" inspect whole.exr
check "the light's own map is doubted: $(grep 'does not fit' log)" test "$(grep -c 'does not fit' log)" -eq 0

# Deep and huge: refused at once, within little memory and the smallest stack.
small() { # small CODE TEXT ARGUMENTS...
  expect_in() { ( ulimit -v 1500000 -s 256; run "$@" ); }
  local code
  code=$(exit_code expect_in "${@:3}")
  check "${*:3}: exit $code instead of $1: $(head -c 300 log)" test "$code" -eq "$1"
  check "${*:3}: no \"$2\" in: $(head -c 300 log)" grep -qF -- "$2" log
}
python3 - <<'PY'
dots = "a." * 32000 + "a"
open("deep.toml", "w").write(dots + " = 1\n")
open("list.toml", "w").write("a = " + "[" * 100000)
for name, text in (("deep", "[" * 60_000_000), ("wide", "{\"kagefude\": 1, \"a\": [" + "1," * 20_000_000 + "1]}"),
                   ("objects", "{\"a\":" * 10_000_000)):
    open(name + ".json", "w").write(text)
open("string.exr", "wb").write(b"\x76\x2f\x31\x01\2\0\0\0a\0string\0\xff\xff\xff\x7f")
open("floats.exr", "wb").write(b"\x76\x2f\x31\x01\2\0\0\0a\0floatvector\0\xfc\xff\xff\x7fabc")
import struct, zlib
head = struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0)
png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + b"IHDR" + head + struct.pack(">I", zlib.crc32(b"IHDR" + head))
open("profile.png", "wb").write(png + struct.pack(">I", 0x7ffffff0) + b"iCCP" + b"ab")
PY
small 2 "64 deep" comp deep.toml one.exr -o x.exr
small 2 "64 deep" comp list.toml one.exr -o x.exr
small 2 "64 parts" comp look.toml one.exr -o x.exr --set "$(printf 'a.%.0s' $(seq 30000))a=1"
for name in deep wide objects; do
  cp one.exr "$name.exr"
  small 1 "$name.json" comp look.toml "$name.exr" -o x.exr
  rm "$name.json"
done
small 1 "attribute a claims" inspect string.exr
small 1 "attribute a claims" inspect floats.exr
small 1 "iCCP claims" strip check profile.png
for frames in 1-10000000 1,2-9999999; do
  small 1 "it has 1-3" comp look.toml 'in/shot.####.exr' -o 'x.####.exr' --frames "$frames"
done
small 1 "9998997 more are not there" comp look.toml 'in/shot.####.exr' -o 'skipped/x.####.exr' \
  --frames 1-10000000 --skip-bad-frames
check "missing frames by the million: $(ls skipped)" test "$(find skipped -name '*.exr' | wc -l)" -eq 3

# The log cannot be forged.
cp one.exr forged.exr
sed 's/"name": "Key"/"name": "Key\\nERROR: forged\\u001b[31m"/' one.json >forged.json
exit_code run inspect forged.exr >code
check "a name's line break in inspect" test "$(grep -c '^ERROR' log)" -eq 0
check "an escape code in inspect" test "$(grep -c $'\033' log)" -eq 0
exit_code run comp look.toml forged.exr -o x.exr --progress openjd >code
check "a name's line break in comp: $(cat log)" test "$(grep -c '^ERROR: forged' log)" -eq 0
check "an escape code in comp" test "$(grep -c $'\033' log)" -eq 0

# A result that cannot be printed is no success.
full() {
  local code=0
  "$kagefude" "$@" >/dev/full 2>log || code=$?
  check "$*: a full disk, exit $code" test "$code" -eq 1
  check "$*: a full disk, no sentence" grep -q '^ERROR:' log
}
full --version
full --help
full inspect one.exr
full inspect one.exr --json
full passes
full passes smooth
full strip check strips/one.png
full strip make strips/other.png
full compare one.exr one.exr --channel data.Depth
full bench --size 64x64 --rounds 1

# The painted strip's own keys are listed by the name that its help gives.
expect 0 "stroke_width" passes strip

# Warnings are one line a kind and a run, whatever the frames' objects and numbers are.
mkdir bare
for i in 1 2 3; do cp "in/shot.000$i.exr" "bare/b.000$i.exr"; done
cat >bare.toml <<'LOOK'
[[light]]
name = "Key"
masks = ["mask.Key.0", "mask.Key.1"]
position = [2.0, -2.0, 4.0]
[[style]]
object = "*"
strip = "builtin:soft"
LOOK
expect 0 "have no bounds in a sidecar" comp bare.toml 'bare/b.####.exr' -o 'bared/b.####.exr' --threads 1
check "warnings repeat: $(grep '^warning' log)" \
  test -z "$(grep '^warning' log | sed 's/([^)]*)//g; s/[0-9]\{1,\}/#/g' | sort | uniq -d)"
check "objects by line: $(grep -c 'no bounds' log)" test "$(grep -c 'no bounds' log)" -eq 1

# A picture that is no strip ends with a sentence.
oiiotool --pattern noise 64x64 3 -d uint8 -o noise.png
expect 1 "ERROR: noise.png is not fit to paint with" strip check noise.png

# A report that cannot be written stops no frame, and is no success.
if [ "$(id -u)" -eq 0 ] && mkdir small && mount -t tmpfs -o size=8k tmpfs small 2>/dev/null; then
  expect 1 "ERROR: the report is not complete" comp look.toml 'in/shot.####.exr' -o 'reported/shot.####.exr' --report small/report
  check "a full report folder: frames" test "$(ls reported | wc -l)" -eq 3
  umount small
fi

# What a killed run left in the report's folder goes with the next.
mkdir -p report/thumbs
run comp look.toml in/shot.0001.exr -o x.exr --report report >log 2>&1
: >"report/thumbs/.0001.png.kagefude-elsewhere-1-0.tmp"
touch -d '1 hour ago' "report/thumbs/.0001.png.kagefude-elsewhere-1-0.tmp"
run comp look.toml in/shot.0001.exr -o x.exr --report report >log 2>&1
check "a leftover in the report" test -z "$(find report -name '.*.tmp')"

# update: whatever decides the pixels, and whether the output is whole.
update() { run comp "$@" --existing update 2>&1 | tail -1; }
again() { # again EXPECTED WHY ARGUMENTS...
  local text
  text=$(update "${@:3}")
  check "$2: expected \"$1\", got \"$text\"" test "$text" = "$1"
}
made='1 frame done'
kept='0 frames done, 1 kept'
whole=(look.toml in/shot.0002.exr -o cut.exr --preview cut)
again "$made" "first" "${whole[@]}"
again "$kept" "again" "${whole[@]}"
truncate -s -100 cut.exr
again "$made" "an output that was cut" "${whole[@]}"
truncate -s -10 cut/cut.png
again "$made" "a preview that was cut" "${whole[@]}"
again "$kept" "whole again" "${whole[@]}"

cp in/shot.0001.exr foreign.exr
echo '{"asset": "x"}' >foreign.json
expect 1 "no light" comp look.toml foreign.exr -o x.exr
check "someone else's JSON is not called that: $(cat log)" grep -q "foreign.json beside the frame is none of kagefude's" log

echo "$(basename "$0"): $passed passed, $failed failed"
[ "$failed" -eq 0 ]
