#!/usr/bin/env bash
# Paints the strips of the examples with `kagefude strip make`.   examples/make_strips.sh KAGEFUDE DIR
# Stops are place, red, green, blue in sRGB from the darkest row to the brightest; shadows lean to
# blue and violet and lights to yellow, as painters mix them. Strips of these names in DIR are painted anew.
set -euo pipefail
kagefude=$1
folder=$2
mkdir -p "$folder"
paint() {  # name preset stops [key=value ...]
  local name=$1 preset=$2 stops=$3
  shift 3
  local settings=(--set "stops=[$stops]")
  for setting in "$@"; do settings+=(--set "$setting"); done
  "$kagefude" strip make "$folder/$name.png" --preset "$preset" "${settings[@]}" --force
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
# The walk's: low sun, so lights lean to gold and shadows to blue.
paint skin   soft "0,0.36,0.20,0.30, 0.3,0.62,0.36,0.36, 0.6,0.93,0.66,0.50, 0.85,0.99,0.82,0.64, 1,1,0.93,0.80" jitter=0.045 stroke_width=44 stroke_length=150 seed=12
paint tunic  soft "0,0.06,0.11,0.21, 0.3,0.10,0.25,0.33, 0.6,0.24,0.48,0.44, 0.85,0.58,0.70,0.50, 1,0.90,0.88,0.62" jitter=0.11 stroke_width=40 stroke_length=150 seed=13
paint dusk   soft "0,0.07,0.07,0.15, 0.4,0.19,0.18,0.29, 0.75,0.38,0.34,0.41, 1,0.72,0.62,0.54" jitter=0.09 stroke_width=40 stroke_length=150 seed=14
paint boots  soft "0,0.13,0.07,0.11, 0.4,0.32,0.17,0.14, 0.75,0.60,0.36,0.20, 1,0.92,0.70,0.42" jitter=0.09 stroke_width=40 stroke_length=150 seed=15
paint scarf  soft "0,0.42,0.20,0.16, 0.3,0.70,0.40,0.14, 0.65,0.96,0.70,0.18, 1,1,0.93,0.56" jitter=0.09 stroke_width=40 stroke_length=150 seed=16
paint hair   fine "0,0.15,0.05,0.12, 0.3,0.36,0.12,0.13, 0.6,0.68,0.30,0.16, 0.85,0.93,0.56,0.26, 1,1,0.80,0.48" jitter=0.11 stroke_width=40 stroke_length=150 seed=17
paint cloak  soft "0,0.18,0.05,0.19, 0.3,0.44,0.07,0.17, 0.6,0.80,0.17,0.15, 0.85,0.95,0.42,0.23, 1,1,0.68,0.42" jitter=0.11 stroke_width=48 stroke_length=150 seed=18
paint meadow soft "0,0.18,0.19,0.31, 0.25,0.34,0.33,0.30, 0.5,0.66,0.55,0.24, 0.75,0.90,0.74,0.34, 1,1,0.91,0.58" jitter=0.11 stroke_width=44 stroke_length=150 seed=19
paint grass  soft "0,0.10,0.19,0.22, 0.4,0.27,0.39,0.17, 0.75,0.64,0.66,0.20, 1,0.95,0.90,0.46" jitter=0.11 stroke_width=40 stroke_length=150 seed=20
paint gold   soft "0,0.43,0.20,0.13, 0.4,0.74,0.42,0.10, 0.75,0.96,0.68,0.18, 1,1,0.90,0.50" jitter=0.11 stroke_width=40 stroke_length=150 seed=21
paint rust   soft "0,0.30,0.08,0.17, 0.4,0.62,0.17,0.12, 0.75,0.90,0.40,0.16, 1,1,0.70,0.36" jitter=0.11 stroke_width=40 stroke_length=150 seed=22
paint bark   soft "0,0.14,0.11,0.20, 0.4,0.29,0.20,0.25, 0.75,0.54,0.38,0.33, 1,0.85,0.66,0.46" jitter=0.11 stroke_width=40 stroke_length=150 seed=23
paint sky    soft "0,0.25,0.40,0.53, 0.35,0.43,0.60,0.65, 0.65,0.78,0.81,0.71, 0.85,0.97,0.89,0.70, 1,1,0.95,0.78" jitter=0.045 stroke_width=60 stroke_length=150 seed=24
