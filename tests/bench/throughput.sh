#!/usr/bin/env bash
# Frames a second on two threads with zip inputs: neighbouring frames overlapped in one run, against a call
# per frame, and against one run that works on one frame at a time.
#    tests/bench/throughput.sh [--at-least RATIO] [WxH]     (RATIO: of overlapped to a call per frame)
# They take turns, and the best of three turns counts, so that other work on the machine weighs alike.
set -euo pipefail
least=0
size=640x360
while [ $# -gt 0 ]; do
  case $1 in
    --at-least) least=$2; shift 2 ;;
    *) size=$1; shift ;;
  esac
done
source "$(dirname "${BASH_SOURCE[0]}")/../e2e/frames.sh"
count=16
mkdir "$work/in"
oiiotool "$data/shot.0001.exr" --resample "$size" --compression zip -o "$work/in/shot.0001.exr"
for i in $(seq "$count"); do
  name=$(printf 'shot.%04d' "$i")
  [ "$i" -eq 1 ] || ln "$work/in/shot.0001.exr" "$work/in/$name.exr"
  cp "$data/shot.0001.json" "$work/in/$name.json"
done
cp "$data/shot.Key.depth.0001.exr" "$work/in/"
printf '[output]\nlayers = ["visibility.*"]\n' >"$work/look.toml"
comp() { # comp INPUT OUTPUT OPTIONS...
  "$kagefude" comp "$work/look.toml" "$work/in/$1" -o "$work/out/$2" --threads 2 --progress none "${@:3}" 2>"$work/log"
}
calls() {
  local i
  for i in $(seq "$count"); do
    comp "shot.$(printf %04d "$i").exr" "shot.$(printf %04d "$i").exr"
  done
}
milliseconds() { # of a command
  local begin
  begin=$(date +%s%N)
  "$@"
  echo $((($(date +%s%N) - begin) / 1000000))
}
least_of() { echo $(($1 < $2 ? $1 : $2)); }
single=999999
one=999999
many=999999
for _ in 1 2 3; do
  single=$(least_of "$single" "$(milliseconds calls)")
  one=$(least_of "$one" "$(milliseconds comp 'shot.####.exr' 'shot.####.exr' --frames-at-once 1)")
  many=$(least_of "$many" "$(milliseconds comp 'shot.####.exr' 'shot.####.exr')")
done
awk -v single="$single" -v one="$one" -v many="$many" -v n="$count" -v size="$size" -v least="$least" 'BEGIN {
  printf "%s, 2 threads, frames/s: a call per frame %.1f, one at a time %.1f, overlapped %.1f\n", size, n * 1000 / single, n * 1000 / one, n * 1000 / many
  printf "overlapped: %.2f times a call per frame, %.2f times one at a time\n", single / many, one / many
  exit single / many < least }'
