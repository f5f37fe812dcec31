#!/usr/bin/env bash
# The whole chain on a small Blender frame against a reference that was looked at; the same bits for
# any number of threads; clear errors that leave nothing behind.
# To renew the reference after a change that is meant: run with RENEW=1, and look at the picture.
set -euo pipefail
cd "$(dirname "$0")/../.."
kagefude=$PWD/build/release/kagefude
data=$PWD/tests/data/still
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
passed=0
pass() { passed=$((passed + 1)); }
fail() { echo "FAILED: $1" >&2; failed=$((failed + 1)); }

cat >"$work/look.toml" <<'LOOK'
[output]
layers = ["visibility.*", "brush.*", "surface.id"]
[[style]]
object = ["Vase", "Bowl"]
strip = "builtin:fine"
[[style]]
material = "Red Cloth"
strip = "builtin:cel"
LOOK
comp() { "$kagefude" comp "$work/look.toml" "$data/shot.0001.exr" -o "$1" --progress none "${@:2}"; }

comp "$work/two.exr" --threads 2
comp "$work/one.exr" --threads 1
cmp -s "$work/one.exr" "$work/two.exr" && pass || fail "one and two threads give other files"

reference=tests/data/still_reference.exr
if [ -n "${RENEW:-}" ]; then
  oiiotool "$work/two.exr" --ch R,G,B,A,visibility.Key,brush.tone -d half -o $reference
fi
# Half floats step by 1/2048 near 1; an eighth of an 8-bit step leaves room for that and no more.
oiiotool "$work/two.exr" --ch R,G,B,A,visibility.Key,brush.tone -o "$work/chosen.exr"
idiff -q -fail 0.0015 -failpercent 0 "$work/chosen.exr" $reference >/dev/null && pass ||
  fail "the picture differs from $reference"

# The windows and the unknown metadata of the input are kept.
oiiotool "$data/shot.0001.exr" --ch data.Position.X,data.Position.Y,data.Position.Z,data.Normal.X,data.Normal.Y,data.Normal.Z,data.IndexOB.V,data.IndexMA.V,mask.Key.0.V,mask.Key.1.V,mask.Key.2.V,mask.Key.3.V,mask.Key.4.V,mask.Key.5.V,mask.Key.6.V,mask.Key.7.V,mask.Key.8.V \
  --origin -7+5 --fullsize 300x200-20-10 --attrib studio "north" --attrib:type=float PixelAspectRatio 2 -o "$work/moved.0001.exr"
cp "$data/shot.Key.depth.0001.exr" "$work/"
sed 's/shot.0001.exr/moved.0001.exr/' "$data/shot.0001.json" >"$work/moved.0001.json"
"$kagefude" comp "$work/look.toml" "$work/moved.0001.exr" -o "$work/moved_out.exr" --progress none --set output.passthrough=true
info=$(iinfo -v "$work/moved_out.exr")
for expected in 'pixel data origin: x=-7, y=5' 'full/display size: 300 x 200' 'studio: "north"' 'PixelAspectRatio: 2' 'data.IndexMA.V'; do
  grep -qF -- "$expected" <<<"$info" && pass || fail "not carried over: $expected"
done

# Time code, rate, view and every channel's own type and bits pass through.
oiiotool "$work/moved.0001.exr" -d float -d data.IndexMA.V=uint -d mask.Key.0.V=half \
  --attrib:type=timecode smpte:TimeCode "01:02:03:04" --attrib:type=rational FramesPerSecond "24000/1001" \
  --attrib view left --attrib:type=float mine/number 2.5 -o "$work/typed.0001.exr"
sed 's/shot.0001.exr/typed.0001.exr/' "$data/shot.0001.json" >"$work/typed.0001.json"
"$kagefude" comp "$work/look.toml" "$work/typed.0001.exr" -o "$work/typed_out.exr" --progress none --set output.passthrough=true
before=$(iinfo -v "$work/typed.0001.exr")
after=$(iinfo -v "$work/typed_out.exr")
for expected in smpte:TimeCode FramesPerSecond view mine/number 'pixel data origin'; do
  line=$(grep -F -- "$expected" <<<"$before") || fail "the input has no $expected"
  grep -qxF -- "$line" <<<"$after" && pass || fail "not carried over: $line"
done
for expected in 'data.IndexMA.V (uint)' 'mask.Key.0.V (half)' 'data.Position.X (float)'; do
  grep -qF -- "$expected" <<<"$after" && pass || fail "another type than $expected"
done
for channel in data.IndexMA.V mask.Key.0.V data.Position.X data.Normal.Z; do
  for side in typed.0001 typed_out; do oiiotool "$work/$side.exr" --ch $channel -o "$work/$side.$channel.exr"; done
  idiff -q -fail 0 -warn 0 "$work/typed.0001.$channel.exr" "$work/typed_out.$channel.exr" >/dev/null && pass ||
    fail "$channel is changed"
done

# expect_error CODE TEXT ARGUMENTS...: exit code, one sentence, nothing written.
expect_error() {
  local code=$1 text=$2 got=0 message
  shift 2
  message=$("$kagefude" "$@" 2>&1 >/dev/null) || got=$?
  [ "$got" -eq "$code" ] || fail "exit $got instead of $code: $* ($message)"
  grep -qF -- "$text" <<<"$message" || fail "expected \"$text\" in: $message"
  [ -z "$(find "$work" -name 'bad*' -o -name '.bad*')" ] || fail "left behind: $(find "$work" -name '*bad*')"
  pass
}
bad=$work/bad.exr
look=$work/look.toml
expect_error 2 'smoth (did you mean smooth?)' comp "$look" "$data/shot.0001.exr" -o "$bad" --set smoth.h=1
expect_error 2 'outside its range' comp "$look" "$data/shot.0001.exr" -o "$bad" --set smooth.h=-1
echo '[pair]
serch = "grid"' >"$work/wrong.toml"
expect_error 2 'wrong.toml:2: [pair] has no key serch (did you mean search?)' comp "$work/wrong.toml" "$data/shot.0001.exr" -o "$bad"
expect_error 2 'there is no built-in strip sof' comp "$look" "$data/shot.0001.exr" -o "$bad" --set 'style[0].strip="builtin:sof"'
expect_error 1 'none.png' comp "$look" "$data/shot.0001.exr" -o "$bad" --set 'style[0].strip="none.png"'
expect_error 2 'required' comp "$look" "$data/shot.0001.exr"
expect_error 2 'frames' comp "$look" "$data/shot.0001.exr" -o "$bad" --frames 1-abc
expect_error 1 'none.exr' comp "$look" "$work/none.exr" -o "$bad"
expect_error 1 'Postion' comp "$look" "$data/shot.0001.exr" -o "$bad" --set frame.position=Postion
expect_error 2 'brush.contrast: there is more than one value' comp "$look" "$data/shot.0001.exr" -o "$bad" --set $'brush.contrast=1\nnonsense=7'
cp "$data/shot.0001.exr" "$work/foreign.exr"
echo '{"asset": 7}' >"$work/foreign.json"
expect_error 1 "foreign.json beside the frame is none of kagefude's" comp "$look" "$work/foreign.exr" -o "$bad"
head -c 300000 "$data/shot.0001.exr" >"$work/short.exr"
cp "$data/shot.0001.json" "$work/short.json"
expect_error 1 'short.exr' comp "$look" "$work/short.exr" -o "$bad"
echo 'no picture' >"$work/text.exr"
expect_error 1 'text.exr' comp "$look" "$work/text.exr" -o "$bad"
oiiotool "$data/shot.0001.exr" --ch data.Position.X,data.Position.Y,data.Position.Z,mask.Key.0.V -o "$work/partial.exr"
expect_error 1 'Normal' comp "$look" "$work/partial.exr" -o "$bad"
expect_error 1 'masks' comp "$look" "$data/shot.0001.exr" -o "$bad" --set shadow.method=pair
expect_error 1 'no light takes part' comp "$look" "$data/shot.0001.exr" -o "$bad" --set 'shadow.lights=["Fill"]'
expect_error 2 'there is no pass piar (did you mean pair?)' passes piar

# NaN and Inf are background, counted in a warning.
oiiotool "$data/shot.0001.exr" --cut 20x10+100+60 --mulc 1e38 --mulc 1e38 -o "$work/inf.exr"
oiiotool "$work/inf.exr" "$data/shot.0001.exr" --paste +100+60 -d float -o "$work/holes.exr"
sed 's/shot.0001.exr/holes.exr/' "$data/shot.0001.json" >"$work/holes.json"
warning=$("$kagefude" comp "$look" "$work/holes.exr" -o "$work/filled.exr" --progress none 2>&1)
grep -qF 'NaN or Inf in Position or Normal is taken as background (200 pixels)' <<<"$warning" && pass || fail "no warning of 200 bad pixels: $warning"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
