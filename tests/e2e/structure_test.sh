#!/usr/bin/env bash
# Includes in src/ point one way only: a folder may include itself and those before it in this list.
set -euo pipefail
cd "$(dirname "$0")/../../src"
order=(base image passes frame look compositor sequence cli)
bad=0
for i in "${!order[@]}"; do
  for j in "${!order[@]}"; do
    [ "$j" -gt "$i" ] || continue
    if grep -rnE "^#include \"${order[$j]}/" "${order[$i]}"; then
      echo "^ ${order[$i]}/ must not include ${order[$j]}/" >&2
      bad=1
    fi
  done
done
for folder in */; do
  [[ " ${order[*]} " == *" ${folder%/} "* ]] || { echo "src/$folder has no place in the order" >&2; bad=1; }
done
[ "$bad" -eq 0 ] && echo "structure: includes point one way"
exit "$bad"
