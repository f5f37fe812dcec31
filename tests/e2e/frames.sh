# For tests that need a sequence; sourced. Sets kagefude and data, and makes $work, which goes at the
# end, with everything that was mounted below it.
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
kagefude=$PWD/build/release/kagefude
data=$PWD/tests/data/still
work=$(mktemp -d)
finish() {
  mountpoint -q "$work/small" 2>/dev/null && umount "$work/small"
  rm -rf "$work"
}
trap finish EXIT
failed=0
passed=0
pass() { passed=$((passed + 1)); }
fail() { echo "FAILED: $1" >&2; failed=$((failed + 1)); }
check() { # check MESSAGE COMMAND...: the command must succeed
  local message=$1
  shift
  if "$@"; then pass; else fail "$message"; fi
}
summary() {
  echo "$(basename "$0"): $passed passed, $failed failed"
  [ "$failed" -eq 0 ]
}

# make_frames FOLDER COUNT [WxH]: shot.0001.exr ... cut from the still life at changing places (data
# windows inside the display window), each with its JSON.
make_frames() {
  local folder=$1 count=$2 size=${3:-64x36} i name command=(oiiotool "$data/shot.0001.exr")
  mkdir -p "$folder"
  cp "$data/shot.Key.depth.0001.exr" "$folder/"
  for ((i = 1; i <= count; i++)); do
    name=$(printf 'shot.%04d' "$i")
    command+=(--dup --crop "$size+$((30 + i * 7 % 120))+$((20 + i * 5 % 70))" -o "$folder/$name.exr" --pop)
    sed "s/shot.0001.exr/$name.exr/; s/\"frame\": 1,/\"frame\": $i,/" "$data/shot.0001.json" >"$folder/$name.json"
  done
  "${command[@]}"
}

# same_files A B: both folders hold the same files, byte for byte, and nothing hidden.
same_files() { diff -rq "$1" "$2" >&2 && [ -z "$(find "$1" "$2" -name '.*' -type f)" ]; }

# exit_code COMMAND...: runs it with its output in $work/log; prints its exit code.
exit_code() {
  local code=0
  "$@" >"$work/log" 2>&1 || code=$?
  echo "$code"
}
