#!/usr/bin/env bash
# Times the passes beside their peers in one run and prints ratios with their gates; then the whole
# frame against copying it.
#   tests/bench/run.sh [--filter REGEX]     with a filter only the benchmarks that match it
# Exit 1 when a gate is missed. Only the ratios mean anything; the machine is named for the record.
set -euo pipefail
cd "$(dirname "$0")/../.."
filter=.
[ "${1:-}" = --filter ] && filter=$2
.ci/ensure_packages build test bench
[ -f build/release/build.ninja ] || cmake --preset release >/dev/null
cmake --build --preset release --target kagefude kagefude_bench
build/release/kagefude_bench --benchmark_filter="$filter" \
  --benchmark_enable_random_interleaving=true --benchmark_out=build/release/bench.json \
  --benchmark_out_format=json >/dev/null
missed=0
python3 tests/bench/gates.py build/release/bench.json || missed=1
if [ "$filter" = . ]; then
  echo
  python3 tests/bench/whole_frame.py build/release/kagefude || missed=1
fi
exit $missed
