#!/usr/bin/env bash
# One overlapped run is at least 1.3 times as fast as a call per frame, on two threads with zip inputs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[ "$(nproc)" -ge 2 ] || { echo "throughput_long.sh: skipped: one processor"; exit 0; }
tests/bench/throughput.sh --at-least 1.3
