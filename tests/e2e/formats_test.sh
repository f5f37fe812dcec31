#!/usr/bin/env bash
# Every format that OpenImageIO reads here, as a strip: a table of what each gives against the same
# strip as PNG, or of the sentence that refuses it. Then damaged files of every one.
set -euo pipefail
cd "$(dirname "$0")/../.."
kagefude=$PWD/build/release/kagefude
data=$PWD/tests/data/still
make_pictures=$PWD/tests/picture/make_pictures.py
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
passed=0
pass() { passed=$((passed + 1)); }
fail() { echo "FAILED: $1" >&2; failed=$((failed + 1)); }
cd "$work"

# One strip in 8 bits: as it is, and half transparent, its colours by themselves (straight) and
# multiplied by alpha.
"$kagefude" strip make made.png --preset fine --set width=128 --set height=64 >/dev/null
quiet() { oiiotool "$@" >/dev/null 2>&1; }
quiet made.png -d uint8 -o plain.png
quiet made.png -d uint8 -o plain.ppm
quiet plain.png --ch R,G,B,A=0.501961 -d uint8 --attrib oiio:UnassociatedAlpha 1 -o half.png
quiet plain.png --ch R,G,B,A=0.501961 --premult -d uint8 -o multiplied.tif
quiet plain.png --ch R -d uint8 -o grey.png
mkdir by_hand
python3 "$make_pictures" plain.ppm by_hand

printf '[output]\ncolour = "float"\n[[style]]\nobject = "*"\nstrip = "STRIP"\n' >look.toml
# comp STRIP OUT [--set ...]
comp() {
  sed "s#STRIP#$1#" look.toml >own.toml
  "$kagefude" comp own.toml "$data/shot.0001.exr" -o "$2" --progress none "${@:3}"
}
comp plain.png plain.exr
comp half.png half.exr
comp grey.png grey.exr
declare -A seen
row() { printf '%-10s %-16s %s\n' "$1" "$2" "$3"; }

# works FORMAT FILE REFERENCE MOST [--set ...]: the comp with FILE differs by at most MOST.
works() {
  local format=$1 file=$2 reference=$3 most=$4
  seen[$format]=1
  if ! comp "$file" out.exr "${@:5}" 2>error; then
    fail "$format: $(cat error)"
    return
  fi
  local worst
  worst=$(idiff out.exr "$reference" -fail 0 -failpercent 0 -warn 0 | awk '/Max error/ { print $4 }') || true
  worst=${worst:-0}
  row "$format" "$file" "works, differs by at most $worst"
  awk -v w="$worst" -v m="$most" 'BEGIN { exit !(w + 0 <= m) }' && pass || fail "$file differs by $worst"
}
# refused FORMAT FILE WORDS: a sentence that has WORDS in it, exit 1, nothing written.
refused() {
  seen[$1]=1
  rm -f out.exr
  local code=0
  comp "$2" out.exr 2>error || code=$?
  row "$1" "$2" "refused: $(sed 's/.*ERROR: //; s/^strip //' error | head -c 110)"
  [ $code -eq 1 ] && [ "$(wc -l <error)" -eq 1 ] && grep -qF -- "$3" error && [ ! -e out.exr ] && pass ||
    fail "$2 is not refused well: $code $(cat error)"
}
# made FILE: the plain strip in that format; made FROM FILE [ARGUMENT...]: another, treated.
made() {
  [ $# -gt 1 ] || set -- plain.png "$1"
  quiet "$1" "${@:3}" -o "$2" || fail "oiiotool does not write $2"
}

same=1e-6        # 8 bits of the same values
rounded=0.03     # divided by alpha after 8 bits, or by a lossy codec: some steps of 1/255
row FORMAT FILE VERDICT
for pair in bmp:bmp dpx:dpx fits:fits ico:ico iff:iff jpeg2000:jp2 sgi:sgi targa:tga tiff:tif; do
  made plain.${pair#*:}
  works "${pair%:*}" plain.${pair#*:} plain.exr $same
done
made plain.png tiled.tif --tile 32 32
made plain.png uint16.tif -d uint16
made plain.png float.tif -d float
for file in tiled uint16 float; do works tiff $file.tif plain.exr $same; done
made plain.png halves.tif -d half --attrib:type=int tiff:half 1
works tiff halves.tif plain.exr 0.01   # a half holds 11 bits
maketx plain.png -o plain.tx >/dev/null
works tiff plain.tx plain.exr $same
# What the codec loses, in linear light; HEIF's also halves the colours' resolution.
for file in plain.jpg:jpeg:0.1 plain.webp:webp:0.15 plain.heic:heif:0.3 plain.avif:heif:0.3 plain.rla:rla:0.01 \
            plain.gif:gif:0.1; do
  IFS=: read -r name format most <<<"$file"
  made plain.png $name --quality 98
  works $format $name plain.exr $most
done
# Scene-linear by what the file says.
for file in linear.exr:openexr:1e-5 linear.hdr:hdr:0.02; do
  IFS=: read -r name format most <<<"$file"
  made plain.png $name --colorconvert sRGB linear -d float
  works $format $name plain.exr $most
done
# PPM is Rec709 by its definition, and so says OpenImageIO; colour.strip knows better.
works pnm plain.ppm plain.exr $same --set colour.strip=sRGB
for file in flat.psd:psd flat.dds:dds flat.pic:softimage; do
  works ${file#*:} by_hand/${file%:*} plain.exr $same
done
works cineon by_hand/log.cin plain.exr 0.01 --set colour.strip=sRGB
refused cineon by_hand/log.cin "its colours are KodakLog"
made grey.png grey.tif && works tiff grey.tif grey.exr $same
made grey.png grey.zfile -d float && works zfile grey.zfile grey.exr $same --set colour.strip=sRGB

# Alpha by the file's own convention.
for file in half.tga:targa half.tif:tiff; do
  quiet --no-autopremult half.png --attrib oiio:UnassociatedAlpha 1 -o ${file%:*}
  works ${file#*:} ${file%:*} half.exr $same
done
quiet --no-autopremult half.png -o half.bmp && works bmp half.bmp half.exr $same
quiet --no-autopremult half.png -o half.ico && works ico half.ico half.exr $same
works dds by_hand/alpha.dds half.exr $same
works psd by_hand/alpha.psd half.exr $rounded
for file in half.sgi:sgi half.iff:iff half.dpx:dpx multiplied.tif:tiff; do
  [ -e ${file%:*} ] || made multiplied.tif ${file%:*}
  works ${file#*:} ${file%:*} half.exr $rounded
done

# Refused by name.
made plain.png inks.tif --ch R,G,B,A=1 --attrib tiff:ColorSpace CMYK
refused tiff inks.tif "is in CMYK"
refused psd by_hand/cmyk.psd "is in CMYK"
refused dicom by_hand/scan.dcm "it is a medical recording"
cp plain.ppm plain.null
refused null plain.null "it is no picture"
# Has no reader: such a file is read by what it holds.
cp plain.ppm plain.term
works term plain.term plain.exr $same --set colour.strip=sRGB
quiet plain.png plain.png --siappend -o pages.tif && refused tiff pages.tif "holds several pictures"
made plain.png five.tif --ch R,G,B,A=1,Z=1 && refused tiff five.tif "has 5 channels"
seen[png]=1
row png plain.png "the reference, read without OpenImageIO"
for name in ffmpeg openvdb raw; do
  seen[$name]=1
  row $name - "refused by its format's name; nothing here writes one to show it"
done
while read -r name; do
  [ -n "${seen[$name]:-}" ] && pass || fail "nothing is known of the format $name"
done < <(oiiotool --list-formats | awk '/ : / { print $1 }')

# Damaged files of the formats that only this test writes (the others: picture_file_test.cpp): cut at several lengths, and with bytes that are wrong. One sentence or a picture,
# the program's own exit, and no more memory than 700 MiB, worker and all.
python3 - "$work" <<'PYTHON'
import pathlib, random, sys
random.seed(15)
work = pathlib.Path(sys.argv[1])
(work / 'bad').mkdir()
taken = {file.suffix: file for file in sorted(work.glob('by_hand/*'))}
for suffix, file in taken.items():
    data = file.read_bytes()
    for share in (3, 40):
        (work / 'bad' / f'cut{share}{suffix}').write_bytes(data[:len(data) * share // 100])
    for number in range(3):
        bad = bytearray(data)
        for _ in range(1 + number):
            bad[random.randrange(min(len(bad), 200 if number % 2 else len(bad)))] = random.randrange(256)
        (work / 'bad' / f'wrong{number}{suffix}').write_bytes(bad)
PYTHON
for file in bad/*; do
  code=0
  /usr/bin/time -f %M -o memory "$kagefude" strip check "$file" >/dev/null 2>error || code=$?
  [ $code -le 1 ] && [ "$(wc -l <error)" -le 1 ] && [ "$(tail -n 1 memory)" -lt 716800 ] && pass ||
    fail "$file: exit $code, $(tail -n 1 memory) KiB: $(cat error)"
  [[ $file != bad/cut* ]] || grep -q 'cannot be read\|damaged\|cannot hold\|allowed\|truncated\|cannot be used' error && pass ||
    fail "$file is not refused: $(cat error)"
done
echo "$(find bad -type f | wc -l) damaged files"
echo "formats: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
