#!/usr/bin/env bash
# Includes in src/ point one way only: a room may include itself and those before it in its list.
# Rooms within passes/ have an order of their own.
set -euo pipefail
cd "$(dirname "$0")/../../src"
house=(base image passes exr picture oiio colour frame look compositor imagebuf sequence live cli)
passes=(search tone strip light_shape depth_map casters brush edges ground measure)
bad=0

# check PREFIX ROOM...: the rooms below PREFIX (empty: all of src/) in their order.
check() {
  local prefix=$1 i j folder
  shift
  local order=("$@")
  for i in "${!order[@]}"; do
    for j in "${!order[@]}"; do
      [ "$j" -gt "$i" ] || continue
      if grep -rnE "^#include \"$prefix${order[$j]}/" "$prefix${order[$i]}"; then
        echo "^ $prefix${order[$i]}/ must not include $prefix${order[$j]}/" >&2
        bad=1
      fi
    done
  done
  for folder in "./$prefix"*/; do
    folder=$(basename "$folder")
    [[ " ${order[*]} " == *" $folder "* ]] ||
      { echo "src/$prefix$folder has no place in the order" >&2; bad=1; }
  done
}
check "" "${house[@]}"
check passes/ "${passes[@]}"

# Long files hide more than one thing.
while read -r lines file; do
  [ "$file" = total ] && continue
  [ "$lines" -le 350 ] || { echo "$file has $lines lines, more than 350" >&2; bad=1; }
done < <(cd .. && git ls-files -z -- 'src/*.cpp' 'src/*.h' 'tests/*.cpp' 'tests/*.h' 'tests/*.py' \
           'tests/*.sh' 'blender_export/*.py' | xargs -0 wc -l)
[ "$bad" -eq 0 ] && echo "structure: includes point one way, no file is too long"
exit "$bad"
