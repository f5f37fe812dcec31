#!/usr/bin/env bash
# The hot passes take no more instructions than recorded (tests/bench/instructions.json).
set -euo pipefail
cd "$(dirname "$0")/../.."
python3 tests/bench/instructions.py build/release/kagefude_plain
