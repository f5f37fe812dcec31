#!/usr/bin/env bash
# What a whole shot costs, from Blender to the last frame: two tables for the README, of a light scene
# and of one of a million triangles, whose lamp moves. The first says where the seconds go, the second
# what each choice of masks, codec and packing buys.
#   tests/quality/shot.sh [--frames 24] [--size 1920x1080] [--scenes ball_and_box,heads] [--samples 1]
#                         [--choice-frames 3]     (so many frames, the first, for each choice)
#   --frames 0 leaves the first table out
#   tests/quality/shot.sh --frames 2 --choice-frames 1 --size 320x180     to try it, in two minutes
# BLENDER is the command to run, KAGEFUDE the program. Seconds in files are those of the comp's report
# in a run with one frame at a time, so that reading, computing and writing do not overlap; they include
# packing and unpacking. Pictures are compared in all of their channels. Exit 1 when a choice that loses
# nothing changes a bit of one. Takes half an hour on two idle cores, and 4 GB below build/shot.
set -euo pipefail
cd "$(dirname "$0")/../.."
exec python3 tests/quality/shot.py "$@"
