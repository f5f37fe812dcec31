#!/usr/bin/env bash
# What one call costs beyond its frame: the whole call less the seconds that it reports for reading,
# computing and writing the frame; the least of twenty calls, with two built-in strips.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../e2e/frames.sh"
make_frames "$work/in" 1
printf '[[style]]\nobject = "Vase"\nstrip = "builtin:fine"\n' >"$work/look.toml"
least=999
for _ in $(seq 20); do
  begin=$(date +%s%N)
  "$kagefude" comp "$work/look.toml" "$work/in/shot.0001.exr" -o "$work/out.exr" 2>"$work/log"
  end=$(date +%s%N)
  frame=$(grep -oE 'done in [0-9.]+' "$work/log" | grep -oE '[0-9.]+')
  least=$(awk -v a="$least" -v b="$begin" -v e="$end" -v f="$frame" 'BEGIN { t = (e - b) / 1e6 - f * 1000; print t < a ? t : a }')
done
printf 'start-up %.0f ms beyond the frame (that is known to 5 ms)\n' "$least"
