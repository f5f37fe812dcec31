#!/usr/bin/env bash
# What soft shadows cost: export and comp by each way to render masks, beside Cycles' own soft
# shadows, on a light scene and on one of a million triangles. Prints the table for the README.
#   tests/quality/cost.sh [--scenes A,B] [--samples 16,64,256] [--truth 512] [--by auto,layers,groups]
#                         [--masks pair,disc:9] [--runs 2] [--masks-against build/cost/3.4]
# BLENDER is the command to run (a newer suite: BLENDER="chroot ROOT blender", with this folder
# bound into it; hold its masks against the truth that 3.4 traced), KAGEFUDE the program. Takes ten
# minutes on two idle cores.
set -euo pipefail
cd "$(dirname "$0")/../.."
exec python3 tests/quality/cost.py "$@"
