#!/usr/bin/env bash
# Unit tests under the address and undefined-behaviour sanitizers, the batch loop under the thread
# sanitizer, and a minute of fuzzing for each reader. By hand: clang builds for most of an hour.
#   tests/gate.sh [SECONDS]
set -euo pipefail
cd "$(dirname "$0")/.."
.ci/ensure_packages build test gate
export ASAN_OPTIONS=allocator_may_return_null=0:detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1
# Tests that fork would wait for ever for children that the sanitizer ends.
export TSAN_OPTIONS=die_after_fork=0:halt_on_error=1:suppressions=$PWD/tests/tsan.supp

echo "-- thread sanitizer: batch tests"
[ -f build/tsan/build.ninja ] || cmake --preset tsan >/dev/null
cmake --build --preset tsan
build/tsan/kagefude_batch_tests --gtest_brief=1

echo "-- address and undefined-behaviour sanitizers: unit tests"
[ -f build/asan/build.ninja ] || cmake --preset asan >/dev/null
cmake --build --preset asan
build/asan/kagefude_tests --gtest_brief=1
build/asan/kagefude_exr_tests --gtest_brief=1

echo "-- fuzzing"
tests/fuzz/run.sh "${1:-60}"
