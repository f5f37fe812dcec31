#!/usr/bin/env bash
# 200 small frames, killed at ten random moments and resumed after each: the end is that of an unbroken
# run, and whoever watches the folder never sees anything but whole, right frames.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/frames.sh"

make_frames "$work/in" 200
printf '[output]\nlayers = ["visibility.*"]\n' >"$work/look.toml"
command=("$kagefude" comp "$work/look.toml" "$work/in/shot.####.exr" --progress none -o)
begin=$(date +%s%N)
"${command[@]}" "$work/whole/shot.####.exr" 2>"$work/log"
taken=$((($(date +%s%N) - begin) / 1000000))

mkdir "$work/out"
python3 tests/e2e/watch_folder.py "$work/whole" "$work/out" "$work/stop" >"$work/watched" &
watcher=$!
killed=0
RANDOM=${SEED:-$$}
echo "seed $RANDOM; an unbroken run takes $taken ms"
for _ in $(seq 10); do
  "${command[@]}" "$work/out/shot.####.exr" --existing update 2>"$work/log" &
  process=$!
  # Spread over the run: at most a quarter of it, so that ten turns hardly come to its end.
  wait_ms=$((30 + RANDOM % (taken / 4 + 1)))
  sleep "$(printf '0.%03d' $((wait_ms % 1000)))"
  sleep $((wait_ms / 1000))
  kill -9 "$process" 2>/dev/null && killed=$((killed + 1))
  wait "$process" 2>/dev/null || true
done
check "killed $killed times" test "$killed" -ge 5
check "some frames are done, not all" test "$(ls "$work/out" | wc -l)" -gt 0
"${command[@]}" "$work/out/shot.####.exr" --existing update 2>"$work/log"
touch "$work/stop"
check "the watcher saw a partial file: $(cat "$work/watched")" wait "$watcher"
cat "$work/watched"
tail -1 "$work/log"
check "the resumed run differs from the unbroken one" same_files "$work/whole" "$work/out"
summary
