#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test.   tests/run.sh [--long]
# --long adds the tests that take minutes (Blender exports, farm, sanitizers); CI sets it.
set -euo pipefail
cd "$(dirname "$0")/.."
long=
for argument in "$@"; do
  case $argument in
    --long) long=1 ;;
    *) echo "usage: tests/run.sh [--long]" >&2; exit 2 ;;
  esac
done

.ci/ensure_packages build test render
[ -f build/release/build.ninja ] || cmake --preset release >/dev/null
cmake --build --preset release
export KAGEFUDE_LONG_TESTS=$long
python3 -m unittest discover -s tests/blender_export -p 'test_*.py'
ctest --preset release -j2

shopt -s nullglob
scripts=(tests/e2e/*_test.sh)
[ -z "$long" ] || scripts+=(tests/e2e/*_long.sh)
for script in "${scripts[@]}"; do
  echo "== $script"
  bash "$script"
done
