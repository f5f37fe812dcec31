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
heading() { echo "== $1 (after $((SECONDS / 60)) min $((SECONDS % 60)) s)"; }

.ci/ensure_packages build test render
heading "build"
[ -f build/release/build.ninja ] || cmake --preset release >/dev/null
cmake --build --preset release
export KAGEFUDE_LONG_TESTS=$long
heading "exporter"
python3 -m unittest discover -s tests/blender_export -p 'test_*.py'
python3 -m unittest discover -s tests/blender_export -p 'comped_*.py'
heading "unit tests: each in a process of its own, then all in one in a new order"
log=build/release/unit_tests.log
ctest --preset release -j2 >"$log" || { cat "$log"; exit 1; }
tail -n 6 "$log"

shopt -s nullglob
scripts=(tests/e2e/*_test.sh)
[ -z "$long" ] || scripts+=(tests/e2e/*_long.sh)
for script in "${scripts[@]}"; do
  heading "$script"
  bash "$script"
done
heading "done"
echo "$((${#scripts[@]})) scripts passed, 0 failed"
