#!/usr/bin/env bash
# The gate: the batch loop under the thread sanitizer; the library under the address and
# undefined-behaviour sanitizers with plane indices checked, tried by the unit tests of build/release
# and by a minute of fuzzing for each reader.
#   tests/gate.sh [build|tests|unit|fuzz] [SECONDS]     without a step: all of them
# `build` wants the release build configured; its tests are compiled there and linked here.
set -euo pipefail
cd "$(dirname "$0")/.."
step=all
case ${1:-} in build | tests | unit | fuzz) step=$1; shift ;; esac
seconds=${1:-60}
export ASAN_OPTIONS=allocator_may_return_null=0:detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=die_after_fork=0:halt_on_error=1:suppressions=$PWD/tests/tsan.supp

# Not here: what compares pictures of every setting (minutes, and each of the passes has its own
# tests), and what measures resident memory, which is the sanitizer's.
not_here='-*Sweep*:OwnKeys.*:PlaneMemory.*'

build() {
  .ci/ensure_packages build test gate
  ninja -C build/release kagefude_tests kagefude_exr_tests >/dev/null
  for preset in tsan asan; do
    cmake --preset "$preset" >/dev/null
    cmake --build --preset "$preset"
  done
}
tests() {
  echo "-- thread sanitizer: batch tests"
  build/tsan/kagefude_batch_tests --gtest_brief=1
  echo "-- address and undefined-behaviour sanitizers: tests of the EXR code"
  build/asan/kagefude_exr_tests --gtest_brief=1
}
unit() {
  echo "-- address and undefined-behaviour sanitizers: unit tests"
  build/asan/kagefude_tests --gtest_brief=1 --gtest_filter="$not_here"
}

[ "$step" != all ] && [ "$step" != build ] || build
[ "$step" != all ] && [ "$step" != tests ] || tests
[ "$step" != all ] && [ "$step" != unit ] || unit
[ "$step" != all ] && [ "$step" != fuzz ] || tests/fuzz/run.sh "$seconds"
