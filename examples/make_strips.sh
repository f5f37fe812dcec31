#!/usr/bin/env bash
# Paints the strips of the examples with `kagefude strip make`.   examples/make_strips.sh KAGEFUDE DIR
# Stops are place, red, green, blue in sRGB from the darkest row to the brightest; shadows lean to
# blue and violet and lights to yellow, as painters mix them.
set -euo pipefail
kagefude=$1
folder=$2
mkdir -p "$folder"
paint() {  # name preset stops [key=value ...]
  local name=$1 preset=$2 stops=$3
  shift 3
  local settings=(--set "stops=[$stops]")
  for setting in "$@"; do settings+=(--set "$setting"); done
  "$kagefude" strip make "$folder/$name.png" --preset "$preset" "${settings[@]}"
}
paint ochre soft "0,0.16,0.13,0.20, 0.3,0.38,0.27,0.28, 0.6,0.72,0.52,0.33, 0.85,0.90,0.73,0.47, 1,0.98,0.88,0.66" jitter=0.055 stroke_width=52 seed=2
paint wall  soft "0,0.13,0.15,0.24, 0.35,0.26,0.34,0.42, 0.7,0.46,0.57,0.58, 1,0.76,0.82,0.74" jitter=0.055 stroke_width=52 seed=3
paint teal  soft "0,0.04,0.07,0.17, 0.25,0.04,0.18,0.29, 0.55,0.07,0.38,0.42, 0.8,0.25,0.61,0.58, 1,0.78,0.92,0.80" jitter=0.055 stroke_width=52 seed=4
paint pear  soft "0,0.16,0.16,0.14, 0.3,0.33,0.35,0.10, 0.6,0.62,0.62,0.16, 0.85,0.86,0.82,0.33, 1,0.98,0.96,0.66" jitter=0.055 stroke_width=52 seed=5
paint orange soft "0,0.26,0.08,0.15, 0.3,0.55,0.18,0.08, 0.6,0.87,0.41,0.08, 0.85,0.97,0.63,0.20, 1,1,0.86,0.55" jitter=0.055 stroke_width=52 seed=6
paint plum  soft "0,0.10,0.04,0.14, 0.4,0.27,0.10,0.27, 0.75,0.47,0.22,0.39, 1,0.80,0.60,0.68" jitter=0.055 stroke_width=52 seed=7
paint red   soft "0,0.16,0.04,0.12, 0.35,0.42,0.07,0.11, 0.7,0.72,0.17,0.13, 1,0.93,0.47,0.33" jitter=0.055 stroke_width=52 seed=8
paint china soft "0,0.20,0.22,0.37, 0.35,0.45,0.50,0.62, 0.7,0.80,0.82,0.82, 1,1,0.98,0.92" jitter=0.055 stroke_width=52 seed=9
paint clay  soft "0,0.22,0.10,0.14, 0.35,0.47,0.23,0.18, 0.7,0.75,0.45,0.32, 1,0.95,0.72,0.54" jitter=0.055 stroke_width=52 seed=10
paint wood  fine "0,0.17,0.10,0.10, 0.4,0.42,0.26,0.14, 0.75,0.75,0.54,0.28, 1,0.95,0.80,0.52" jitter=0.055 stroke_width=52 seed=11
