#!/usr/bin/env bash
# Fuzzes every harness from the seeds in corpus/.   tests/fuzz/run.sh [SECONDS [HARNESS...]]
# Two at a time, SECONDS (60) each. With KAGEFUDE_FUZZ_SEED they go the same way on every machine: from
# the seeds alone, to a number of inputs that most of them reach in that time.
# An input that crashes stays in build/fuzz; when its bug is mended it goes into
# tests/fuzz/corpus/HARNESS, where the unit tests replay it for ever.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-60}
shift || true
program=$PWD/build/asan/kagefude_fuzz
found=$PWD/build/fuzz
mkdir -p "$found"
mapfile -t harnesses < <([ $# -gt 0 ] && printf '%s\n' "$@" || "$program" list)
"$program" dictionary >"$found/look.dict"

# Odd allocations are what untrusted files ask for: 2 GB at most for all, 600 MB for one.
fuzz() {
  local harness=$1 options=(-max_total_time="$seconds")
  [[ $harness == look || $harness == override || $harness == save ]] && options=(-dict="$found/look.dict")
  if [ -n "${KAGEFUDE_FUZZ_SEED:-}" ]; then
    options+=(-seed="$KAGEFUDE_FUZZ_SEED" -runs=20000)
    rm -rf "${found:?}/$harness"
  fi
  mkdir -p "$found/$harness"
  "$program" "$harness" -timeout=20 -rss_limit_mb=2048 \
    -malloc_limit_mb=600 -max_len=8192 -print_final_stats=1 "${options[@]}" \
    -artifact_prefix="$found/$harness-" \
    "$found/$harness" "tests/fuzz/corpus/$harness" \
    >"$found/$harness.log" 2>&1
}

passed=0
failed=0
wait_for() {  # PROCESS HARNESS
  local runs
  if wait "$1"; then
    runs=$(awk '/stat::number_of_executed_units/ {print $2}' "$found/$2.log")
    echo "fuzz $2: $runs runs, nothing found"
    passed=$((passed + 1))
  else
    echo "FAILED: fuzz $2 (build/fuzz/$2.log):" >&2
    grep -m 5 -E 'ERROR|SUMMARY|runtime error|terminate|Test unit' "$found/$2.log" >&2 || true
    failed=$((failed + 1))
  fi
}
for ((i = 0; i < ${#harnesses[@]}; i += 2)); do
  fuzz "${harnesses[i]}" & first=$!
  second=
  [ $((i + 1)) -ge ${#harnesses[@]} ] || { fuzz "${harnesses[i + 1]}" & second=$!; }
  wait_for "$first" "${harnesses[i]}"
  [ -z "$second" ] || wait_for "$second" "${harnesses[i + 1]}"
done
echo "fuzz: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
