#!/usr/bin/env bash
# One frame in the forms in which pipelines have it: one EXR, tiled, mip-mapped, in parts, several
# EXRs, TIFFs: the same comp, bit for bit. And the sentences for what does not belong together.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/frames.sh"
cd "$work"
quiet() { oiiotool "$@" >/dev/null 2>&1 || fail "oiiotool $*"; }
whole=$data/shot.0001.exr
cat >look.toml <<'LOOK'
[output]
layers = ["visibility.*", "brush.*", "surface.id"]
edges = "pixel"
[[style]]
object = ["Vase", "Bowl"]
strip = "builtin:fine"
LOOK
# folder FORM: a folder for the frame in that form, with JSON and depth map.
folder() {
  mkdir -p "$1"
  cp "$data/shot.Key.depth.0001.exr" "$data/shot.0001.json" "$1"
}
comp() { "$kagefude" comp look.toml "$1" -o "$2" --progress none "${@:3}"; }
# same FORM [--set ...]: the comp of FORM/shot.0001.exr has the bits of the whole file's.
same() {
  if comp "$1/shot.0001.exr" "$1.exr" "${@:2}" 2>error; then
    idiff -fail 0 -failpercent 0 whole.exr "$1.exr" >/dev/null && pass || fail "$1 gives another picture"
  else
    fail "$1: $(cat error)"
  fi
}
cp "$whole" shot.0001.exr
cp "$data/shot.Key.depth.0001.exr" "$data/shot.0001.json" .
comp shot.0001.exr whole.exr

folder tiled && quiet "$whole" --tile 64 64 -o tiled/shot.0001.exr && same tiled
folder piz && quiet "$whole" --compression piz -o piz/shot.0001.exr && same piz
folder mips && quiet "$whole" -d float -otex:filter=box:resize=0 mips/shot.0001.exr && same mips

position=data.Position.X,data.Position.Y,data.Position.Z
normal=data.Normal.X,data.Normal.Y,data.Normal.Z
albedo=data.DiffCol.R,data.DiffCol.G,data.DiffCol.B
ids=data.IndexOB.V,data.IndexMA.V,data.Depth.V
beauty=beauty.Combined.R,beauty.Combined.G,beauty.Combined.B,beauty.Combined.A
masks=$(seq -s, -f 'mask.Key.%g.V' 0 8)
folder parts
quiet "$whole" --ch $beauty --attrib oiio:subimagename beauty "$whole" --ch $position,$normal,$albedo,$ids \
  --attrib oiio:subimagename data "$whole" --ch "$masks" --attrib oiio:subimagename masks \
  --siappendall -o parts/shot.0001.exr && same parts

# Several EXRs, one cropped to where it has anything, with their channels' full names.
folder files
quiet "$whole" --ch $beauty -o files/shot.0001.exr
quiet "$whole" --ch $position,$ids,$albedo -o files/shot.P.0001.exr
quiet "$whole" --ch $normal -o files/shot.N.0001.exr
quiet "$whole" --ch "$masks" -o files/shot.masks.0001.exr
same files --set 'frame.files=["shot.P.####.exr", "shot.N.####.exr", "shot.masks.####.exr"]'

# Without positions: rebuilt from the depth and the JSON's camera, or the header's alone. Places
# differ by a millionth, so the shadow search takes another step here and there in a penumbra; all
# but 0.5 % of the picture is the same within a half float's step, of the visibility within 0.01.
others=$beauty,$normal,$albedo,$ids,$masks
# close MOST FORM ARGUMENT...: what oiiotool makes of both comps by those is as near.
close() {
  local form
  for form in whole "$2"; do quiet "$form.exr" "${@:3}" -o "close.$form.exr"; done
  idiff -fail "$1" -failpercent 0.5 -warn "$1" -warnpercent 0.5 -hardfail 0.3 close.whole.exr "close.$2.exr" >difference &&
    pass || fail "$2 gives another picture: $(tail -8 difference)"
}
# near FORM NAME: FORM/NAME.exr gives nearly the whole file's picture, and says what it was made from.
near() {
  if comp "$1/shot.0001.exr" "$1.exr" "${@:3}" 2>error; then
    close 0.004 "$1" --ch R,G,B,A
    close 0.01 "$1"
    grep -qF "positions are rebuilt from data.Depth, taken as $2" error && pass || fail "$1 says: $(cat error)"
  else
    fail "$1: $(cat error)"
  fi
}
folder depth && quiet "$whole" --ch "$others" -o depth/shot.0001.exr && near depth "planar, and the JSON's camera"
# Ray depth: planar depth over the cosine, by the JSON's projection, whose axis is in the middle.
folder ray && quiet "$whole" --ch "$others" -o ray/flat.exr && python3 - ray <<'PY'
import array, json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
shot = json.loads((folder / "shot.0001.json").read_text())
(width, height), clip = shot["resolution"], shot["camera"]["clip_from_camera"]
across = [((2 * (x + 0.5) / width - 1) / clip[0][0]) ** 2 for x in range(width)]
down = [((2 * (y + 0.5) / height - 1) / clip[1][1]) ** 2 for y in range(height)]
stretch = array.array("f", [(1 + a + d) ** 0.5 for d in down for a in across])
(folder / "stretch.pfm").write_bytes(f"Pf\n{width} {height}\n-1.0\n".encode() + stretch.tobytes())
PY
quiet ray/flat.exr --ch data.Depth.V ray/stretch.pfm --mul --chnames data.Depth.V -o ray/depth.exr
quiet ray/flat.exr --ch "${others/,data.Depth.V/}" ray/depth.exr --chappend -o ray/shot.0001.exr
comp ray/shot.0001.exr ray.exr 2>error && fail "ray depth was taken as planar" ||
  { grep -q 'set frame.depth_kind = "ray"' error && pass || fail "ray depth: $(cat error)"; }
near ray "ray, and the JSON's camera" --set frame.depth_kind=ray

# Depth of half precision, and in centimetres, is said to be so.
folder cm && quiet depth/shot.0001.exr --ch data.Depth.V --mulc 100 -d half -o cm/depth.exr
quiet depth/shot.0001.exr --ch "${others/,data.Depth.V/}" cm/depth.exr --chappend -d data.Depth.V=half -o cm/shot.0001.exr
"$kagefude" comp look.toml cm/shot.0001.exr -o cm.exr --progress plain 2>error
grep -q 'if the depth were 0.01 times as large' error && grep -q 'of half precision' error && pass || fail "centimetres: $(cat error)"

# TIFFs beside an EXR beauty: bare R, G, B under the layers that the look names.
folder tiffs
cp files/shot.0001.exr tiffs/
quiet "$whole" --ch $position -d float -o tiffs/p.0001.tif
quiet "$whole" --ch $normal -d float -o tiffs/n.0001.tif
quiet "$whole" --ch $albedo -d float -o tiffs/a.0001.tif
quiet "$whole" --ch data.IndexOB.V -d float -o tiffs/ob.0001.tif
list='"data.Position=p.####.tif", "data.Normal=n.####.tif", "data.DiffCol=a.####.tif", "data.IndexOB=ob.####.tif"'
for k in 0 1 2 3 4 5 6 7 8; do
  quiet "$whole" --ch mask.Key.$k.V -d uint8 -o tiffs/m$k.0001.tif
  list+=", \"mask.Key.$k=m$k.####.tif\""
done
same tiffs --set "frame.files=[$list]"
# Ids as whole numbers of 8 bits are the same ids.
quiet "$whole" --ch data.IndexOB.V --divc 255 -d uint8 -o tiffs/ob.0001.tif
same tiffs --set "frame.files=[$list]"

# As Arnold writes: a file an AOV with bare channels, in the folder's or the file's name; per view.
python3 - <<'PYTHON'
import json
frame = json.load(open('shot.0001.json'))
frame['layers'] = {}
frame['image'] = 'shot.left.beauty.0001.exr'
json.dump(frame, open('plain.json', 'w'))
PYTHON
mkdir -p bare/N
cp "$data/shot.Key.depth.0001.exr" bare/
cp plain.json bare/shot.left.beauty.0001.json
quiet "$whole" --ch $beauty --chnames R,G,B,A -o bare/shot.left.beauty.0001.exr
quiet "$whole" --ch $position --chnames R,G,B -o bare/shot.left.P.0001.exr
quiet "$whole" --ch $normal --chnames R,G,B -o bare/N/shot.left.0001.exr
quiet "$whole" --ch $albedo --chnames R,G,B -o bare/shot.left.albedo.0001.exr
quiet "$whole" --ch data.IndexOB.V,data.Depth.V --chnames IndexOB.V,Depth.V -o bare/shot.left.ids.0001.exr
quiet "$whole" --ch "$masks" -o bare/shot.left.masks.0001.exr
every='frame.files=["shot.%V.P.####.exr", "N/shot.%V.####.exr", "shot.%V.albedo.####.exr", "shot.%V.ids.####.exr", "shot.%V.masks.####.exr"]'
comp 'bare/shot.%V.beauty.####.exr' 'bare.%V.####.exr' --views left --set "$every" 2>error || fail "bare: $(cat error)"
idiff -fail 0 -failpercent 0 whole.exr bare.left.0001.exr >/dev/null && pass || fail "bare gives another picture"

# A change of any file makes the frame stale; the same files keep it.
run() {
  "$kagefude" comp look.toml 'bare/shot.%V.beauty.####.exr' -o 'bare.%V.####.exr' --views left --set "$every" \
    --existing update --progress plain 2>&1
}
grep -q '1 kept' <(run) && pass || fail "an unchanged frame is made again"
touch -d '2001-01-01' bare/N/shot.left.0001.exr
quiet bare/N/shot.left.0001.exr --mulc 1,1,1 --attrib touched yes -o bare/N/shot.left.0001.exr
grep -q '1 kept' <(run) && fail "a changed normal file is not noticed" || pass

# The README's oiiotool chains: a crop before the comp is the comp's crop; a painted plate as albedo;
# a small picture for the web after it.
folder crop
quiet "$whole" --crop 64x48+80+40 -o crop/shot.0001.exr
comp crop/shot.0001.exr crop.exr
iinfo -v crop.exr | grep -q 'pixel data origin: x=80, y=40' && pass || fail "a crop's window is lost"
folder plate
size=$(iinfo whole.exr | grep -oE '[0-9]+ x +[0-9]+' | tr -d ' ')
quiet --create "$size" 3 --fill:color=0.5,0.5,0.5 "$size" -d uint8 -o grade.png
cp files/shot.P.0001.exr files/shot.N.0001.exr files/shot.masks.0001.exr plate/
quiet "$whole" --ch $position,$ids -o plate/shot.0001.exr   # the colour is the plate
# plate BRIGHTNESS: the corner of the comp with a plate that many times as bright.
plate() {
  quiet grade.png --colorconvert sRGB linear --mulc "$1" -d half -o plate/plate.0001.exr
  comp plate/shot.0001.exr plate.exr --set frame.albedo=plate --set output.colour=float --set \
    'frame.files=["shot.N.####.exr", "shot.masks.####.exr", "plate.####.exr"]' >said 2>error || fail "plate: $(cat error)"
  oiiotool plate.exr --ch R --crop 1x1+0+0 --printstats 2>/dev/null | awk '/Stats Min/ { print $3; exit }'
}
once=$(plate 1)
twice=$(plate 2)
ratio=$(awk -v a="$once" -v b="$twice" 'BEGIN { print (a > 0.05 ? b / a : 0) }')
awk -v r="${ratio:-0}" 'BEGIN { exit !(r > 1.99 && r < 2.01) }' && pass || fail "a plate gives $once, one twice as bright $twice"
quiet whole.exr --ch R,G,B --resize 50% --colorconvert linear sRGB -d uint8 -o small.png
[ -s small.png ] && pass || fail "no small.png"

# A TIFF of colours by themselves is the picture that it would be multiplied by its alpha.
folder straight && folder multiplied
quiet "$whole" --ch $beauty --chnames R,G,B,A --mulc 0.5 -d float -o multiplied/shot.0001.tif
quiet multiplied/shot.0001.tif --unpremult --attrib oiio:UnassociatedAlpha 1 -o straight/shot.0001.tif
for form in straight multiplied; do
  comp $form/shot.0001.tif $form.exr --set 'frame.files=["../files/shot.P.####.exr", "../files/shot.N.####.exr", "../files/shot.masks.####.exr"]' 2>error ||
    fail "$form: $(cat error)"
done
iinfo -v straight/shot.0001.tif | grep -q 'UnassociatedAlpha: 1' && pass || fail "not written by themselves"
idiff -fail 0.00001 multiplied.exr straight.exr >/dev/null && pass || fail "straight colours give another picture"

# refused WORDS ARGUMENT...: exit 1 or 2, one sentence, nothing written.
refused() {
  rm -f no.exr
  local code=0
  comp "$2" no.exr "${@:3}" 2>error || code=$?
  [ $code -ge 1 ] && [ $code -le 2 ] && grep -qF -- "$1" error && [ "$(wc -l <error)" -eq 1 ] && [ ! -e no.exr ] && pass ||
    fail "not refused with '$1': $code $(cat error)"
}
quiet files/shot.N.0001.exr --resize 100x100 -o files/shot.small.0001.exr
refused "the files of a frame have one size" files/shot.0001.exr --set 'frame.files=["shot.small.####.exr"]'
refused "shot.gone.0001.exr cannot be read" files/shot.0001.exr --set 'frame.files=["shot.gone.####.exr"]'
refused "frame.files: " files/shot.0001.exr --set 'frame.files=["shot.####.####.exr"]'
quiet "$whole" --ch $position -d uint16 -o tiffs/p.0001.tif
refused "in integers" tiffs/shot.0001.exr --set "frame.files=[$list]"
summary
