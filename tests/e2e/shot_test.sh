#!/usr/bin/env bash
# What a frame's JSON says of its shot and its pixels reaches the picture: pixel aspect, lamps without
# shadow, and the size of scenes that no JSON describes.
set -euo pipefail
source "$(dirname "$0")/frames.sh"

mkdir -p "$work/in"
cp "$data"/shot.0001.* "$data"/shot.Key.depth.0001.exr "$work/in/"
edit() { python3 - "$work/in/shot.0001.json" "$1" <<'PYTHON'
import json, sys
with open(sys.argv[1]) as file: document = json.load(file)
exec(sys.argv[2])
with open(sys.argv[1], "w") as file: json.dump(document, file)
PYTHON
}
comp() { "$kagefude" comp "$work/look.toml" "$work/in/shot.0001.exr" -o "$work/$1" --progress none "${@:2}"; }
printf '[output]\nlayers = ["visibility.Key"]\n' >"$work/look.toml"

comp square.exr
check "square pixels are not square" grep -q 'PixelAspectRatio: 1$' <(oiiotool --info -v "$work/square.exr")
edit 'document["pixel_aspect"] = 2.0'
comp wide.exr
check "the JSON's pixel aspect is lost" grep -q 'PixelAspectRatio: 2$' <(oiiotool --info -v "$work/wide.exr")

# A lamp without shadow shades, and no method that is found by itself darkens it.
edit 'light = document["lights"][0]; light["shadow"] = False; del light["masks"]'
comp lit.exr
oiiotool "$work/lit.exr" --ch visibility.Key --mulc 0 --addc 1 -o "$work/ones.exr"
oiiotool "$work/lit.exr" --ch visibility.Key -o "$work/seen.exr"
check "a lamp without shadow casts one" oiiotool --fail 0 --diff "$work/seen.exr" "$work/ones.exr"
check "a lamp without shadow does not shade" test 1 = "$(oiiotool --fail 0 --failpercent 90 --diff "$work/wide.exr" "$work/lit.exr" >/dev/null && echo 1)"

# Things that are cut or see-through are not painted: the beauty stands there.
cp "$data/shot.0001.json" "$work/in/"
edit 'for thing in document["objects"]: thing["painted"] = False'
printf '[output]\ncolour = "float"\nlayers = ["visibility.Key"]\n' >"$work/look.toml"
comp bare.exr
oiiotool "$work/in/shot.0001.exr" --ch beauty.Combined.R,beauty.Combined.G,beauty.Combined.B --chnames R,G,B -o "$work/beauty.exr"
oiiotool "$work/bare.exr" --ch R,G,B -o "$work/bare_rgb.exr"
check "what is not painted is not the beauty" oiiotool --fail 1e-6 --diff "$work/beauty.exr" "$work/bare_rgb.exr"

# Drawn lines lie over everything.
cp "$data/shot.0001.json" "$work/in/"
edit 'document["layers"]["lines"] = "beauty.Freestyle"'
check "a missing line layer is not named" test 1 = "$(exit_code "$kagefude" comp "$work/look.toml" "$work/in/shot.0001.exr" -o "$work/x.exr" --progress none)"
check "a missing line layer is not named" grep -qF 'has no channel beauty.Freestyle.R' "$work/log"
oiiotool "$data/shot.0001.exr" --create 256x144 4 --fill:color=0.25,0.5,0,1 128x144+0+0 \
  --chnames beauty.Freestyle.R,beauty.Freestyle.G,beauty.Freestyle.B,beauty.Freestyle.A --chappend -d float -o "$work/in/shot.0001.exr"
comp lines.exr
cp "$data/shot.0001.exr" "$work/in/" && cp "$data/shot.0001.json" "$work/in/"
comp plain.exr
half() { oiiotool "$1" --ch R,G,B --crop 128x144+$2+0 -o "$3"; }
half "$work/lines.exr" 128 "$work/a.exr" && half "$work/plain.exr" 128 "$work/b.exr" && half "$work/lines.exr" 0 "$work/c.exr"
oiiotool "$work/c.exr" --fill:color=0.25,0.5,0 128x144+0+0 -o "$work/d.exr"
check "beside the lines the picture changes" oiiotool --fail 0 --diff "$work/a.exr" "$work/b.exr"
check "lines are not whole" oiiotool --fail 0 --diff "$work/c.exr" "$work/d.exr"

# A light without size has its one mask; a stretched disc is another light than a round one.
edit 'masks = document["lights"][0]["masks"]; masks["arrangement"] = "hard"; masks["samples"] = masks["samples"][:1]'
comp hard.exr
oiiotool "$work/hard.exr" --ch visibility.Key -o "$work/a.exr"
oiiotool "$work/a.exr" --subc 0.5 --abs --addc 0.5 -o "$work/b.exr"
oiiotool "$work/b.exr" --mulc 0 --addc 1 -o "$work/c.exr"
check "a hard shadow is not hard" oiiotool --fail 0 --diff "$work/b.exr" "$work/c.exr"
cp "$data/shot.0001.json" "$work/in/"
edit 'masks = document["lights"][0]["masks"]; masks["offset_v"] = 0.05 * masks["offset"]'
comp stretched.exr
check "a stretched disc is taken for a round one" test -z "$(oiiotool --fail 0 --diff "$work/plain.exr" "$work/stretched.exr" >/dev/null && echo same)"

# Frames without a JSON: what is seen of a thing does not matter once the look says how large the scene is.
printf '[[light]]\nname = "Key"\nposition = [-3, -3, 5]\n[[style]]\nobject = "*"\nstrip = "builtin:fine"\n[frame]\nlayer = "data"\nbeauty_layer = "beauty"\n' >"$work/look.toml"
rm "$work/in/shot.0001.json"
said=$(comp seen.exr 2>&1)
check "strokes that move with the view are not named" grep -qF 'give scene.centre and scene.radius' <<<"$said"
said=$(comp given.exr --set 'scene.centre=[0,0,1]' --set scene.radius=3 2>&1)
check "a scene in the look does not settle it" test -z "$(grep 'no bounds' <<<"$said")"
# A part of the frame is painted as in the whole frame: the same strokes, whatever else is seen.
mv "$work/given.exr" "$work/whole.exr"
cp "$work/in/shot.0001.exr" "$work/all.exr"
oiiotool "$work/all.exr" --crop 100x80+90+40 -o "$work/in/shot.0001.exr"
comp part.exr --set 'scene.centre=[0,0,1]' --set scene.radius=3 2>/dev/null
comp moved.exr 2>/dev/null
inner() { oiiotool "$1" --crop 92x72+94+44 --ch R,G,B -o "$2"; }
inner "$work/whole.exr" "$work/a.exr" && inner "$work/part.exr" "$work/b.exr" && inner "$work/moved.exr" "$work/c.exr"
check "strokes change with what a frame shows" oiiotool --fail 0 --diff "$work/a.exr" "$work/b.exr"
check "the test cannot fail: without [scene] the same" test -z "$(oiiotool --fail 0 --diff "$work/a.exr" "$work/c.exr" >/dev/null && echo same)"
summary
