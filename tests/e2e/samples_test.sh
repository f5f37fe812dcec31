#!/usr/bin/env bash
# inspect, comp and sheet on damaged and foreign files: a report or one sentence, never a crash, and
# nothing left behind. The files are made here; those of other people are added where they lie
# beside the checkout ($KAGEFUDE_SAMPLES, else ../shared/data).
set -euo pipefail
cd "$(dirname "$0")/../.."
kagefude=$PWD/build/release/kagefude
data=$PWD/tests/data/still
samples=${KAGEFUDE_SAMPLES:-$PWD/../shared/data}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
failed=0
check() {  # FILE COMMAND...: exit code 0, 1 or 2, and an error is one line that names the file
  local file=$1 code=0
  shift
  timeout 60 "$@" >"$work/out.txt" 2>"$work/err.txt" || code=$?
  if [ "$code" -gt 2 ]; then
    echo "FAILED: exit $code: $*" >&2
    failed=$((failed + 1))
  elif [ "$code" -ne 0 ] && [ "$(grep -c '^ERROR: ' "$work/err.txt")" -ne 1 ]; then
    echo "FAILED: not one clear error: $*" >&2
    cat "$work/err.txt" >&2
    failed=$((failed + 1))
  elif [ "$code" -ne 0 ] && ! grep -qF "$(basename "$file")" "$work/err.txt"; then
    echo "FAILED: the error does not name $file" >&2
    failed=$((failed + 1))
  else
    passed=$((passed + 1))
  fi
}
all_commands() {
  check "$1" "$kagefude" inspect "$1"
  check "$1" "$kagefude" comp "" "$1" -o "$work/made.exr" --progress none
  check "$1" "$kagefude" sheet "" "$1" -o "$work/made.png"
}
json_of() {
  { "$kagefude" inspect "$1" --json 2>/dev/null || [ $? -eq 1 ]; } | python3 -m json.tool >/dev/null && passed=$((passed + 1)) ||
    { echo "FAILED: no JSON for $1" >&2; failed=$((failed + 1)); }
}

# Sound files of every kind that OpenImageIO writes, from a small frame.
mkdir "$work/sound" "$work/damaged"
oiiotool "$data/shot.0001.exr" --resample 64x36 -o "$work/small.exr"
for codec in none rle zips zip piz pxr24 dwaa; do
  oiiotool "$work/small.exr" --compression "$codec" -o "$work/sound/$codec.exr"
done
oiiotool "$work/small.exr" --tile 16 16 -o "$work/sound/tiles.exr"
oiiotool "$work/small.exr" -d half -o "$work/sound/half.exr"
oiiotool "$work/small.exr" --origin -20+7 --fullsize 100x90-30-2 -o "$work/sound/window.exr"
oiiotool "$work/small.exr" --attrib oiio:subimagename first "$work/small.exr" --attrib oiio:subimagename second --siappend -o "$work/sound/parts.exr"

# The same with bytes flipped, ends missing, sizes that are lies; and what is no EXR at all.
python3 - "$work" <<'DAMAGE'
import pathlib, random, struct, sys
work = pathlib.Path(sys.argv[1])
chance = random.Random(3)
for sound in sorted((work / 'sound').iterdir()):
    good = sound.read_bytes()
    for name, reach in (('header', 900), ('pixels', len(good))):
        bad = bytearray(good)
        for _ in range(4):
            bad[chance.randrange(min(reach, len(bad)))] = chance.randrange(256)
        (work / 'damaged' / f'{sound.stem}_{name}.exr').write_bytes(bad)
    (work / 'damaged' / f'{sound.stem}_cut.exr').write_bytes(good[:chance.randrange(len(good))])
bomb = bytearray((work / 'sound/zip.exr').read_bytes())
key = b'dataWindow\0box2i\0'
struct.pack_into('<2i', bomb, bomb.index(key) + len(key) + 12, 29999, 29999)
(work / 'damaged/bomb.exr').write_bytes(bomb)
(work / 'damaged/empty.exr').write_bytes(b'')
(work / 'damaged/text.exr').write_bytes(b'no picture\n')
DAMAGE
oiiotool --create 8x8 3 -o "$work/damaged/picture.png"
# Half of the files have the JSON of a frame, so that all goes through to the picture.
for file in "$work"/sound/*.exr "$work"/damaged/*_pixels.exr; do
  cp "$data/shot.0001.json" "${file%.exr}.json"
done
cp "$data/shot.Key.depth.0001.exr" "$work/sound/"
cp "$data/shot.Key.depth.0001.exr" "$work/damaged/"

for file in "$work"/sound/*.exr "$work"/damaged/*.{exr,png}; do all_commands "$file"; done
for file in "$work"/sound/*.exr; do json_of "$file"; done
if [ -d "$samples" ]; then
  while IFS= read -r file; do
    all_commands "$file"
  done < <(find "$samples" -type f ! -name '*.md' ! -name '*.json' | sort)
  for file in "$samples"/cryptomatte/*.exr "$samples"/windows/*.exr; do json_of "$file"; done
fi
rm -rf "$work/sound" "$work/damaged" "$work/small.exr"
# Sound files gave their picture and sheet; nothing else may be there.
left=$(find "$work" -type f ! -name '*.txt' ! -name made.exr ! -name made.png)
[ -z "$left" ] || { echo "FAILED: left behind: $left" >&2; failed=$((failed + 1)); }
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
