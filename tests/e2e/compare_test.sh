#!/usr/bin/env bash
# kagefude compare by values worked out by hand: text, JSON, picture, and clear errors. Then what
# shadow masks must be: of one size, enough of them, and there at all.
set -euo pipefail
. "$(dirname "$0")/frames.sh"

# row FILE CHANNEL VALUE...: an EXR of one row of pixels.
row() {
  local file=$1 channel=$2 value words=()
  shift 2
  for value in "$@"; do words+=(--pattern "constant:color=$value" 1x1 1); done
  oiiotool "${words[@]}" --mosaic "$#x1" --chnames "$channel" -d float -o "$file"
}
says() { # says FILE TEXT...: every text is in the file
  local file=$1 text
  shift
  for text in "$@"; do check "not said: $text (but: $(head -c 400 "$file"))" grep -qF -- "$text" "$file"; done
}

# Errors 0.1, 0.1, 0, -0.3: RMSE √0.0275; the penumbra is the two pixels with truth 0.5.
row "$work/a.exr" visibility.Key 0.6 0.6 1.0 0.7
row "$work/b.exr" truth.Key.V 0.5 0.5 1.0 1.0
"$kagefude" compare "$work/a.exr" "$work/b.exr" --channel visibility.Key --against truth.Key \
  --truth-samples 100 >"$work/text"
says "$work/text" "all 4 pixels: RMSE 0.1658, maximum 0.3000" \
  "penumbra 2 pixels: RMSE 0.1000, bias +0.1000" "median 0.1000, 90 % 0.1000, 99 % 0.1000" \
  "100 samples: up to 0.0500"
"$kagefude" compare "$work/a.exr" "$work/b.exr" --channel visibility.Key --against truth.Key.V \
  --truth-samples 100 --json --picture "$work/d.png" >"$work/json"
python3 - "$work/json" <<'PY' && pass || fail "the JSON is not what hand values give"
import json, math, sys
found = json.load(open(sys.argv[1]))
inner = found["penumbra"]
near = lambda a, b: math.isclose(a, b, abs_tol=1e-6)
assert (found["pixels"], inner["pixels"]) == (4, 2), found
assert near(found["rmse"], math.sqrt(0.0275)) and near(found["maximum"], 0.3), found
assert all(near(inner[key], 0.1) for key in ("rmse", "bias", "median", "p90", "p99")), found
assert near(inner["truth_noise"], 0.05), found
PY
# The picture: 0.5 + 2 x difference in 8 bits.
oiiotool "$work/d.png" --ch 0 -d uint8 -o "$work/d.pgm"
pixels=$(tail -c 4 "$work/d.pgm" | od -An -tu1 | tr -s ' ')
check "the difference picture is$pixels" grep -qE '^ 17[89] 17[89] 12[78] 0$' <<<"$pixels"
"$kagefude" compare "$work/b.exr" "$work/b.exr" --channel truth.Key.V >"$work/text"
says "$work/text" "RMSE 0.0000, maximum 0.0000"

# A picture that was moved is compared where it stands: 0.6, 0.6, 1.0 against 0.5, 1.0, 1.0.
oiiotool "$work/a.exr" --ch visibility.Key --origin +1+0 --fullsize 4x1+0+0 -o "$work/moved.exr"
"$kagefude" compare "$work/moved.exr" "$work/b.exr" --channel visibility.Key --against truth.Key >"$work/text"
says "$work/text" "all 3 pixels" "not counted: 2 pixels that only one of the files covers"
# Where no object is, a visibility of 1 and a truth of 0 mean the same.
row "$work/n.exr" N.X 0 1 0 -1
oiiotool "$work/n.exr" --ch N.X,N.X,N.X --chnames N.X,N.Y,N.Z -o "$work/n3.exr"
oiiotool "$work/b.exr" "$work/n3.exr" --chappend -o "$work/bn.exr"
"$kagefude" compare "$work/a.exr" "$work/bn.exr" --channel visibility.Key --against truth.Key >"$work/text"
says "$work/text" "all 2 pixels: RMSE 0.2236, maximum 0.3000" "not counted: 2 pixels of background"

# refused MESSAGE-PART COMMAND...: exit 1, one line, which holds the part.
refused() {
  local part=$1 code
  shift
  code=$(exit_code "$@")
  check "exit $code of: $*" test "$code" -eq 1
  check "not one line: $(cat "$work/log")" test "$(wc -l <"$work/log")" -eq 1
  says "$work/log" "$part"
}
row "$work/c.exr" truth.Key.V 0.5 0.5
refused "4x1 pixels" "$kagefude" compare "$work/a.exr" "$work/c.exr" --channel visibility.Key --against truth.Key
refused "did you mean visibility.Key" "$kagefude" compare "$work/a.exr" "$work/b.exr" --channel visibility.Kye
refused "nothing.exr" "$kagefude" compare "$work/nothing.exr" "$work/b.exr" --channel visibility.Key

# Masks: a frame with fewer than the method needs, none at all, and one that its file lacks.
make_frames "$work/in" 1
change() { # change CODE: the frame's JSON after Python has changed `masks` of its light
  cp "$work/in/shot.0001.exr" "$work/in/changed.0001.exr"
  python3 - "$work/in/shot.0001.json" "$work/in/changed.0001.json" "$1" <<'PY'
import json, sys
frame = json.loads(open(sys.argv[1]).read().replace("shot.0001.exr", "changed.0001.exr"))
light = frame["lights"][0]
exec(sys.argv[3])
json.dump(frame, open(sys.argv[2], "w"))
PY
}
printf '[[style]]\nobject = "*"\nstrip = "builtin:fine"\n' >"$work/look.toml"
comp=("$kagefude" comp "$work/look.toml" "$work/in/changed.0001.exr" -o "$work/out.exr" --progress none)
change 'light["masks"]["samples"] = light["masks"]["samples"][:4]'
refused "export it with --masks disc:9" "${comp[@]}"
change 'del light["masks"]'
refused "has 0 masks" "${comp[@]}" --set 'shadow.method="disc"'
says "$work/log" "--masks disc:9"
refused "--masks pair" "${comp[@]}" --set 'shadow.method="pair"'
refused "--masks line:5" "${comp[@]}" --set 'shadow.method="line"'
change 'light["masks"]["samples"][3]["layer"] = "mask.Key.99"'
refused "mask.Key.99" "${comp[@]}"
check "an output was left behind" test ! -e "$work/out.exr"
summary
