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
paint ochre soft "0,.16,.13,.20, .3,.38,.27,.28, .6,.72,.52,.33, .85,.90,.73,.47, 1,.98,.88,.66" seed=2
paint wall  soft "0,.13,.15,.24, .35,.26,.34,.42, .7,.46,.57,.58, 1,.76,.82,.74" seed=3
paint teal  soft "0,.04,.07,.17, .25,.04,.18,.29, .55,.07,.38,.42, .8,.25,.61,.58, 1,.78,.92,.80" seed=4
paint pear  soft "0,.16,.16,.14, .3,.33,.35,.10, .6,.62,.62,.16, .85,.86,.82,.33, 1,.98,.96,.66" seed=5
paint orange soft "0,.26,.08,.15, .3,.55,.18,.08, .6,.87,.41,.08, .85,.97,.63,.20, 1,1,.86,.55" seed=6
paint plum  soft "0,.10,.04,.14, .4,.27,.10,.27, .75,.47,.22,.39, 1,.80,.60,.68" seed=7
paint red   soft "0,.16,.04,.12, .35,.42,.07,.11, .7,.72,.17,.13, 1,.93,.47,.33" seed=8
paint china soft "0,.20,.22,.37, .35,.45,.50,.62, .7,.80,.82,.82, 1,1,.98,.92" seed=9
paint clay  soft "0,.22,.10,.14, .35,.47,.23,.18, .7,.75,.45,.32, 1,.95,.72,.54" seed=10
paint wood  fine "0,.17,.10,.10, .4,.42,.26,.14, .75,.75,.54,.28, 1,.95,.80,.52" seed=11
