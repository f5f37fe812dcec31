#!/usr/bin/env bash
# A warm batch of 4K frames beside oiiotool copying them (the same channels read, as many written) and
# beside the disk itself (cat reads the same bytes, dd writes as many and waits for the disk).
#   tests/bench/sequence.sh [--frames 50] [--size 3840x2160] [--rounds 3] [--max-memory 4G]
# The frames are hard links to one, whole_frame.py's: all are read from the page cache, cold disks are
# not measured. KAGEFUDE names the program. Exit 1 when a gate is missed; a busy machine misses those of
# the clock, so the load is printed. Takes ten minutes on two idle cores, and 5 GB below build/.
set -euo pipefail
cd "$(dirname "$0")/../.."
exec python3 tests/bench/sequence.py "$@"
