#!/usr/bin/env bash
# Frames and previews in every format that outputs may have, read back by OpenImageIO and held
# against the EXR of the same comp through oiiotool's own colour conversion: values, alpha, windows,
# metadata; the same bytes every time; made again only where they are stale or cut.
set -euo pipefail
source "$(dirname "$0")/frames.sh"
cd "$work"
# Nothing around the middle, so that alpha has work to do.
oiiotool "$data/shot.0001.exr" --crop 200x110+40+30 --croptofull --attrib studio north --attrib:type=float PixelAspectRatio 2 --attrib Copyright "the house" \
  -o one.0001.exr
cp "$data/shot.Key.depth.0001.exr" .
sed 's/shot.0001.exr/one.0001.exr/' "$data/shot.0001.json" >one.0001.json
printf '[output]\nbackground = "transparent"\n[[style]]\nobject = "*"\nstrip = "builtin:fine"\n' >look.toml
comp() { "$kagefude" comp look.toml "$1" -o "$2" --progress none "${@:3}"; }
comp one.0001.exr one.exr --set output.colour=float

# What a display shows, by oiiotool: colours by themselves through sRGB's curve, held to 0..1.
oiiotool one.exr --ch R,G,B,A --unpremult --colorconvert linear sRGB --clamp:min=0:max=1 -o straight.exr
oiiotool straight.exr --premult -o associated.exr
# Without alpha the frame stands on black before the view.
oiiotool one.exr --ch R,G,B --colorconvert linear sRGB --clamp:min=0:max=1 -o black.exr
oiiotool one.exr --ch R,G,B,A -o linear.exr

# near FILE REFERENCE MOST MEAN: what oiiotool reads is as far from it as rounding makes it.
near() {
  local got
  got=$(oiiotool --iconfig oiio:UnassociatedAlpha 1 "$1" --ch "$(chan "$1")" -d float -o near.exr \
    2>&1 && idiff near.exr "$2" -fail 0 -warn 0 2>&1) || true
  got=$(awk '/Mean error/ { mean = $4 } /Max error/ { max = $4 } /PASS/ { mean = max = 0 } END { print mean, max }' <<<"$got")
  awk -v got="$got" -v most="$3" -v mean="$4" 'BEGIN { split(got, g); exit !(g[1] != "" && g[1] + 0 <= mean && g[2] + 0 <= most) }' &&
    pass || fail "$1 differs from $2 by (mean, most) $got"
}
chan() { case $1 in *.jpg | *.jpeg | a.dpx) echo R,G,B ;; *) echo R,G,B,A ;; esac; }
rounding() { awk -v most="$1" 'BEGIN { print 0.51 / most + 2e-5 }'; }

for row in a.tif:associated:65535 a.tiff:associated:65535 a.png:straight:65535 a.dpx:black:1023; do
  IFS=: read -r file reference most <<<"$row"
  comp one.0001.exr "$file"
  step=$(rounding "$most")
  [ $file != a.dpx ] || step=0.0015 # OpenImageIO cuts 16 bits to 10
  near "$file" $reference.exr "$step" "$step"
done
for row in b.tif:associated:uint8:255 b.png:straight:uint8:255 b.dpx:associated:uint8:255 c.dpx:associated:uint12:4095 d.dpx:associated:uint16:65535; do
  IFS=: read -r file reference depth most <<<"$row"
  comp one.0001.exr "$file" --set output.colour="$depth"
  step=$(rounding "$most")
  [ $depth != uint12 ] || step=0.0005
  near "$file" $reference.exr "$step" "$step"
done
comp one.0001.exr linear.tif --set output.colour=float
near linear.tif linear.exr 0 0
check "16 bits in TIFF" grep -q "uint16 tiff" <(oiiotool --info a.tif)
check "10 bits in DPX" grep -q "uint10 dpx" <(oiiotool --info a.dpx)
check "floats in TIFF" grep -q "float tiff" <(oiiotool --info linear.tif)

# Codecs with loss stay close on the whole; a lossless WebP is exact, as far as OpenImageIO's reader
# is, which multiplies by alpha in 8 bits.
for file in a.jpg a.dpx; do
  "$kagefude" comp look.toml one.0001.exr -o $file --progress plain 2>said
  check "a format without alpha is not said" grep -q "hold no alpha.*stands on black" said
done
near a.jpg black.exr 0.25 0.01
comp one.0001.exr a.webp --set output.quality=100
near a.webp associated.exr 0.0042 0.0042
comp one.0001.exr b.webp
near b.webp associated.exr 0.4 0.012
check "a lower quality is no smaller" test "$(stat -c %s b.webp)" -lt "$(stat -c %s a.webp)"
check "WebP has no alpha" grep -q "4 channel, uint8 webp" <(oiiotool --info a.webp)

# Metadata as OpenImageIO keeps it; the writer names itself.
meta() { check "$1 lacks $2" grep -qF -- "$2" <(oiiotool --info -v "$1"); }
for file in a.png; do
  for words in 'studio: "north"' 'Copyright: "the house"' 'Software: "kagefude '; do meta $file "$words"; done
done
for file in a.tif a.jpg a.dpx; do for words in 'Copyright: "the house"' 'Software: "kagefude '; do meta $file "$words"; done; done
meta a.dpx 'PixelAspectRatio: 2'
meta a.png 'oiio:ColorSpace: "sRGB"'
check "DPX does not hold its own name" grep -q 'a\.dpx' <(head -c 136 a.dpx | tr '\0' '\n')
check "a temporary's name is in an output" test -z "$(grep -l -a 'kagefude-.*\.tmp' a.* b.* || true)"

# The display window: overscan is cut, what a crop lacks is empty.
oiiotool "$data/shot.0001.exr" --origin -7+5 --fullsize 300x200-20-10 -o moved.0001.exr
sed 's/shot.0001.exr/moved.0001.exr/' "$data/shot.0001.json" >moved.0001.json
comp moved.0001.exr moved.exr --set output.colour=float
oiiotool moved.exr --ch R,G,B,A --crop 300x200-20-10 --origin +0+0 --fullsize 300x200+0+0 --unpremult \
  --colorconvert linear sRGB --clamp:min=0:max=1 -o window.exr
for suffix in png tif; do
  comp moved.0001.exr moved.$suffix
  check "$suffix has another window" grep -q "300 x *200" <(oiiotool --info moved.$suffix)
done
near moved.png window.exr "$(rounding 65535)" 1e-5

# The same bytes whenever, and with any number of threads.
sleep 1
for file in a.tif a.png a.dpx a.jpg b.webp; do
  comp one.0001.exr "again.${file#*.}" --threads 1 2>/dev/null
done
for pair in a.tif:tif a.png:png a.jpg:jpg b.webp:webp; do
  check "${pair%:*} has other bytes the second time" cmp -s "${pair%:*}" "again.${pair#*:}"
done
check "a.dpx has other bytes the second time" cmp -s <(tail -c +137 a.dpx) <(tail -c +137 again.dpx)

# Previews.
for suffix in png jpg webp tif dpx; do
  comp one.0001.exr out/one.0001.exr --preview shown --preview-format $suffix
  if [ $suffix = jpg ] || [ $suffix = webp ]; then
    oiiotool shown/one.0001.$suffix --ch R,G,B -d float -o shown.exr
    idiff -q -fail 0.4 -failpercent 1 shown.exr black.exr >/dev/null && pass || fail "the preview as $suffix differs"
  else
    oiiotool shown/one.0001.$suffix -d float -o shown.exr
    idiff -q -fail "$(rounding 255)" -failpercent 0 shown.exr black.exr >/dev/null && pass || fail "the preview as $suffix differs"
  fi
done

# A sequence: kept as it is, made again after a change of the look, of the view, or a cut.
make_frames in 3
made() { "$kagefude" comp "$look" 'in/shot.####.exr' -o "seq/shot.####.$1" --progress plain --existing update "${@:2}" 2>&1 | tail -1 || true; }
look=look.toml
expect_made() { # WANTED SUFFIX ARGUMENT...
  local said
  said=$(made "${@:2}")
  [ "$said" = "$1" ] && pass || fail "$2: $said instead of $1"
}
cat >own.ocio <<'OCIO'
ocio_profile_version: 2
roles: {scene_linear: linear, default: linear}
displays:
  Screen:
    - !<View> {name: Plain, colorspace: dim}
colorspaces:
  - !<ColorSpace> {name: linear}
  - !<ColorSpace> {name: dim, from_scene_reference: !<ExponentTransform> {value: 0.9}}
OCIO
for suffix in png tif dpx jpg webp; do
  expect_made "3 frames done" $suffix
  expect_made "0 frames done, 3 kept" $suffix
  truncate -s -40 seq/shot.0002.$suffix
  expect_made "1 frame done, 2 kept" $suffix
  expect_made "0 frames done, 3 kept" $suffix
done
expect_made "3 frames done" dpx --set tone.gamma=1.1
expect_made "3 frames done" png --set "colour.config=$work/own.ocio"
expect_made "3 frames done" tif --set output.colour=float
expect_made "0 frames done, 3 kept" tif --set output.colour=float --set colour.config=
check "something hidden is left" test -z "$(find . -name '.*' -type f)"

# The report of kept pictures shows them.
"$kagefude" comp look.toml 'in/shot.####.exr' -o 'seq/shot.####.png' --progress none
"$kagefude" comp look.toml 'in/shot.####.exr' -o 'seq/shot.####.png' --progress none --existing update --report report
check "the report has no pictures" test "$(find report -name '*.png' | wc -l)" -ge 3

# Layers have no place there, which is said; a limit on file sizes is what it is.
"$kagefude" comp look.toml one.0001.exr -o layers.png --progress plain --set 'output.layers=["visibility.*"]' 2>said
check "layers are left out without a word" grep -q "output.layers and output.passthrough go into EXRs" said
(ulimit -f 100; comp one.0001.exr large.tif --set output.colour=float) 2>said && fail "a limit was exceeded" || pass
check "the limit is not named: $(cat said)" grep -q "ulimit -f" said
check "a picture beyond the limit is there" test ! -e large.tif

# A worker that is killed as it starts is not said to lack libraries.
mkdir killed
cp "$kagefude" killed/
printf '#!/bin/sh\nkill -9 $$\n' >killed/kagefude-oiio
chmod +x killed/kagefude-oiio
killed/kagefude comp look.toml one.0001.exr -o killed.tif --progress none 2>said && fail "a dead worker writes" || pass
check "a killed worker is said to be something else: $(cat said)" grep -q "ended by signal 9" said
# A disk that is full in the middle of a picture, however little its encoder makes of it.
if [ "$(id -u)" -eq 0 ] && mkdir full && mount -t tmpfs -o size=4k tmpfs full 2>/dev/null; then
  for suffix in png tif jpg dpx webp; do
    code=$(exit_code comp one.0001.exr full/a.$suffix)
    check "a full disk and .$suffix: exit $code" test "$code" -eq 1
    check "a full disk is not named for .$suffix: $(cat "$work/log")" grep -q "a.$suffix cannot be written: No space left" "$work/log"
    check "a full disk keeps a piece of a .$suffix" test -z "$(ls -A full)"
  done
  umount full
else
  echo "skipped: a full disk (needs root and tmpfs)"
fi
summary
