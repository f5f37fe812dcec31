#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test.   tests/run.sh [--long]
# --long adds the tests that take minutes (Blender exports, farm); CI sets it.
set -euo pipefail
cd "$(dirname "$0")/.."
long=
for argument in "$@"; do
  case $argument in
    --long) long=1 ;;
    *) echo "usage: tests/run.sh [--long]" >&2; exit 2 ;;
  esac
done
trap 'kill $(jobs -p) 2>/dev/null || true' EXIT
heading() { echo "== $1 (after $((SECONDS / 60)) min $((SECONDS % 60)) s)"; }

.ci/ensure_packages build test render
heading "build"
# A clean clone compiles the tests in fewer, larger pieces: their headers are most of the work.
[ -f build/release/build.ninja ] || cmake --preset release -DKAGEFUDE_UNITY=ON >/dev/null
cmake --build --preset release
export KAGEFUDE_LONG_TESTS=$long
# The gate is built and fuzzes while tests run that leave a core idle.
gate_log=build/release/gate.log
if [ -n "$long" ]; then
  .ci/ensure_packages gate
  nice -n 19 tests/gate.sh build >"$gate_log" 2>&1 &
  gate=$!
fi
heading "exporter"
python3 -m unittest discover -s tests/blender_export -p 'test_*.py'
python3 -m unittest discover -s tests/blender_export -p 'comped_*.py'
heading "unit tests: each in a process of its own, then all in one in a new order"
log=build/release/unit_tests.log
ctest --preset release -j2 >"$log" || { cat "$log"; exit 1; }
tail -n 6 "$log"
if [ -n "$long" ]; then
  heading "the rest of the gate's build"
  wait "$gate" || { cat "$gate_log"; exit 1; }
  # Always the same way, so that a change is what makes it fail; by hand it goes new ways.
  { KAGEFUDE_FUZZ_SEED=1 nice -n 19 tests/gate.sh fuzz && nice -n 19 tests/gate.sh unit; } >"$gate_log" 2>&1 &
  gate=$!
fi

shopt -s nullglob
scripts=(tests/e2e/*_test.sh)
[ -z "$long" ] || scripts+=(tests/e2e/*_long.sh)
for script in "${scripts[@]}"; do
  heading "$script"
  bash "$script"
done
if [ -n "$long" ]; then
  heading "sanitizers: thread; then address and undefined behaviour"
  tests/gate.sh tests
  heading "fuzzing and the unit tests under sanitizers, begun before the scripts"
  wait "$gate" || { cat "$gate_log"; exit 1; }
  grep -E '^(fuzz|\[)' "$gate_log"
fi
heading "done"
echo "$((${#scripts[@]})) scripts passed, 0 failed"
