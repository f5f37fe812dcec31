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
