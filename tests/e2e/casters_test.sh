#!/usr/bin/env bash
# Every shadow method that works from the casters' shape, on a small Blender frame; lights moved,
# added and switched off in the look; clear errors.
set -euo pipefail
cd "$(dirname "$0")/../.."
kagefude=$PWD/build/release/kagefude
data=$PWD/tests/data/casters
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
passed=0
pass() { passed=$((passed + 1)); }
fail() { echo "FAILED: $1" >&2; failed=$((failed + 1)); }

printf '[output]\nlayers = ["visibility.*"]\n' >"$work/plain.toml"
# comp LOOK NAME [OPTION …]: comps the frame with LOOK.toml into NAME.exr.
comp() {
  "$kagefude" comp "$work/$1.toml" "$data/shot.0001.exr" -o "$work/$2.exr" --progress none \
    "${@:3}" >"$work/log" 2>&1 || fail "$2: $(cat "$work/log")"
}
# statistic Avg|Min|Max OPERATIONS …: of the one channel that the oiiotool operations leave.
statistic() { oiiotool "${@:2}" --printstats | awk -v key="$1:" '$2 == key { print $3 }'; }
# expect TEXT EXPRESSION: awk's word on an arithmetic comparison.
expect() { awk "BEGIN { exit !($2) }" && pass || fail "$1: $2"; }
visible() { echo "$work/$1.exr" --ch "visibility.${2:-Key}"; }
mean() { statistic Avg $(visible "$@"); }
# difference Avg|Max A B: of two visibilities.
difference() { statistic "$1" $(visible "$2") $(visible "$3") --sub --abs; }

for method in coverage volume places; do comp plain $method --set shadow.method=$method; done
for method in planar blob; do
  comp plain $method --set shadow.method=$method --set shadow.receiver=Floor
done
for method in coverage volume places planar blob; do
  expect "$method casts a shadow" "$(mean $method) > 0.8 && $(mean $method) < 0.995"
done
expect "coverage and volume agree" "$(difference Avg coverage volume) <= 1 / 64"

# The smoothing of the other methods, where it is asked for.
for method in coverage volume places planar blob; do
  for h in 0 3; do
    comp plain "smooth$h" --set shadow.method=$method --set shadow.receiver=Floor \
      --set smooth.all_methods=true --set smooth.h=$h
  done
  expect "$method without a window stays as it is" "$(difference Max smooth0 $method) == 0"
  expect "$method is smoothed" "$(difference Max smooth3 $method) > 0.05"
  expect "$method keeps its light" "($(mean smooth3) - $(mean $method)) ^ 2 < 0.0001"
done

# A caster on the receiver does not darken it round its own outline.
expect "planar is dark where coverage is" "$(statistic Max $(visible coverage) $(visible planar) \
  --sub --clamp:min=0:max=1) < 0.1"

# Where all sub-pixels agree, so does the mask that Blender traced from the light's centre.
oiiotool $(visible coverage) "$data/shot.0001.exr" --ch mask.Key.0.V --sub --abs \
  -o "$work/off.exr"
oiiotool $(visible coverage) $(visible coverage) --mulc -1 --addc 1 --mul --mulc 1000 \
  --clamp:min=0:max=1 --mulc -1 --addc 1 -o "$work/even.exr"
# Background, which the mask holds as dark, has object index 0.
oiiotool "$data/shot.0001.exr" --ch data.IndexOB.V --clamp:min=0:max=1 -o "$work/object.exr"
expect "coverage is the traced mask off the edges" \
  "$(statistic Max "$work/off.exr" "$work/even.exr" --mul "$work/object.exr" --mul) == 0"
expect "there are pixels off the edges" "$(statistic Avg "$work/even.exr") > 0.9"

expect "places are the traced masks' soft shadow" "$(
  comp plain masks
  difference Avg places masks) < 0.02"
# Any number of places: the same shadow, sampled more densely.
for places in 12 33; do
  comp plain places$places --set shadow.method=places --set shadow.places=$places
  expect "$places places are the shadow of nine" "$(difference Avg places places$places) < 0.01"
done
comp plain soft --set shadow.method=blob --set shadow.receiver=Floor --set blob.blend=multiply
expect "multiplied blobs are lighter" "$(mean soft) > $(mean blob)"
comp plain faint --set shadow.method=planar --set shadow.receiver=Floor --set planar.alpha=0.2
expect "planar.alpha is the opacity" "$(statistic Min $(visible faint)) == 0.8"

for threads in 1 2; do
  for method in coverage places; do
    comp plain "$method$threads" --set shadow.method=$method --threads $threads
  done
done
for method in coverage places; do
  cmp -s "$work/${method}1.exr" "$work/${method}2.exr" && pass ||
    fail "$method: one and two threads give other files"
done

# A light that the look puts where it already stands keeps its shadow; moved, it has another.
light() { sed 's/^ *//' >"$work/$1.toml" && sed 's/^ *//' "$work/plain.toml" >>"$work/$1.toml"; }
light same <<'LOOK'
  [[light]]
  name = "Key"
  position = [-2.8, -2.0, 4.2]
LOOK
light moved <<'LOOK'
  [[light]]
  name = "Key"
  position = [3.4, -2.4, 3.6]
LOOK
light added <<'LOOK'
  [[light]]
  name = "Lamp"
  position = [3.4, -2.4, 3.6]
  radius = 0.5
LOOK
light off <<'LOOK'
  [[light]]
  name = "Key"
  on = false
  [[light]]
  name = "Lamp"
  position = [3.4, -2.4, 3.6]
LOOK
comp same same --set shadow.method=places
expect "a light put where it stands" "$(difference Max same places) < 0.01"
comp moved moved
comp moved hard --set shadow.method=coverage
expect "a moved light has another shadow" "$(difference Avg moved places) > 0.02"
comp added added
expect "an added light keeps the others" "$(difference Max added masks) == 0"
expect "an added light casts a shadow" "$(mean added Lamp) < 0.98"
comp off off
expect "a hard light added is the one that moved there" "$(statistic Max $(visible off Lamp) \
  $(visible hard) --sub --abs) < 0.001"
oiiotool --info -v "$work/off.exr" | grep -q 'visibility.Key' &&
  fail "a light that is off has a layer" || pass

expect_error() {
  local status=0 message
  message=$("$kagefude" comp "${@:2}" -o "$work/bad.exr" --progress none 2>&1) || status=$?
  [ "$status" -ne 0 ] && grep -qF "$1" <<<"$message" && [ ! -e "$work/bad.exr" ] && pass ||
    fail "exit code $status, wanted an error with \"$1\", got: $message"
}
frame=$data/shot.0001.exr
expect_error 'did you mean Floor?' "$work/plain.toml" "$frame" --set shadow.method=planar \
  --set shadow.receiver=Flor
expect_error 'wants shadow.receiver' "$work/plain.toml" "$frame" --set shadow.method=blob
expect_error 'the receiver Ball of shadow.receiver is not flat' "$work/plain.toml" "$frame" --set shadow.method=planar \
  --set shadow.receiver=Ball
expect_error 'shadow.places is 4, outside its range 5 to 65' "$work/plain.toml" "$frame" \
  --set shadow.method=places --set shadow.places=4
comp plain seventeen --set shadow.method=places --set shadow.places=17
expect "seventeen places are near the traced masks' soft shadow" \
  "$(difference Avg seventeen places) > 0 && $(difference Avg seventeen masks) < 0.02"
expect_error 'export it with --casters' "$work/plain.toml" "$PWD/tests/data/still/shot.0001.exr" \
  --set shadow.method=coverage
cp -r "$data" "$work/broken"
rm "$work"/broken/shot.casters/*.obj
expect_error '.obj' "$work/plain.toml" "$work/broken/shot.0001.exr" --set shadow.method=coverage

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
