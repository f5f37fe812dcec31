#!/usr/bin/env bash
# Does the exporter give the same with other Blenders, and does the program build elsewhere?
#   tests/blender_versions.sh [--exports-only] [SUITE ...]   Debian suites; default: trixie (Blender
#                                                            4.3) and sid (5.2)
# Makes a root of each suite with debootstrap, runs the exporter's tests and exports the examples
# there and with the Blender of this machine, comps all with the same program, builds the program in
# each root and runs its unit tests, and prints a table. By hand, not in CI: a root is 3 GB and takes
# ten minutes, a build as long. Needs root's rights and debootstrap.
#   KAGEFUDE_ROOTS   where the roots are kept ($XDG_CACHE_HOME/kagefude/roots)
#   KAGEFUDE_MIRROR  the mirror to take Debian from (debootstrap's own)
# Leaves pictures, logs and tables in build/versions. Ends with 1 where anything failed or differed.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ "${1:-}" = --inside ]; then
  shift
elif [ "$(id -u)" -ne 0 ]; then
  echo "tests/blender_versions.sh: needs root's rights to make and enter roots; run it with sudo" >&2
  exit 2
else
  # What is mounted below goes with this namespace, however the script ends.
  exec unshare --mount --propagation private "$0" --inside "$@"
fi
build=1
if [ "${1:-}" = --exports-only ]; then
  build=
  shift
fi
suites=("$@")
[ ${#suites[@]} -gt 0 ] || suites=(trixie sid)
roots=${KAGEFUDE_ROOTS:-${XDG_CACHE_HOME:-$HOME/.cache}/kagefude/roots}
out=$PWD/build/versions
kagefude=${KAGEFUDE:-$PWD/build/release/kagefude}
examples=(still_life moving_light)
declare -A frame_of=([still_life]=1 [moving_light]=12)
failures=()
export PYTHONDONTWRITEBYTECODE=1
[ -x "$kagefude" ] || { echo "build $kagefude first" >&2; exit 2; }

# step PLACE WHAT COMMAND...: runs it with its output in a log; says where it failed.
step() {
  local place=$1 what=$2 log
  shift 2
  log=$out/$place/$(tr ' ' _ <<<"$what").log
  mkdir -p "$out/$place"
  echo "$place: $what" >&2
  "$@" >"$log" 2>&1 && return
  failures+=("$place: $what failed; the end of $log:"$'\n'"$(tail -n 5 "$log" | sed 's/^/    /')")
  return 1
}

# within PLACE COMMAND...: in the suite's root, where this repository is /src; or here.
within() {
  local place=$1
  shift
  if [ "$place" = here ]; then "$@"; else
    chroot "$roots/$place" env -C /src PWD=/src HOME=/root LC_ALL=C.UTF-8 "$@"
  fi
}

make_root() {
  local root=$roots/$1
  if [ ! -e "$root/made" ]; then
    mkdir -p "$roots"
    debootstrap --variant=minbase "$1" "$root" ${KAGEFUDE_MIRROR:+"$KAGEFUDE_MIRROR"} || return 1
    touch "$root/made"
  fi
  mkdir -p "$root"/{src,out,proc,dev}
  # Good enough from a mirror that lags behind.
  echo 'Acquire::Check-Valid-Until "false";' >"$root/etc/apt/apt.conf.d/80lagging"
  mountpoint -q "$root/proc" || mount -t proc proc "$root/proc" || return 1
  mountpoint -q "$root/dev" || mount --bind /dev "$root/dev" || return 1
  mount --bind "$PWD" "$root/src" && mount -o remount,bind,ro "$root/src" &&
    mount --bind "$out" "$root/out" && cp /etc/resolv.conf "$root/etc/"
}

# Without the first two Debian's Blender 5 complains at every start, though it does not ask for them;
# the third lets the tests write HEIC files, which Debian 12's libheif does by itself.
install_packages() {
  within "$1" apt-get update -qq && within "$1" .ci/ensure_packages build test render &&
    within "$1" apt-get install -y -qq --no-install-recommends python3-cattr python3-requests libheif-plugin-x265
}

exporter_tests() { within "$1" python3 -m unittest discover -s tests/blender_export -p 'test_*.py'; }

# export_example PLACE NAME: the shot that this machine's Blender saved, small and with a quick beauty.
export_example() {
  local place=$1 name=$2 base=/out before
  [ "$place" = here ] && base=$out
  before=$(sha256sum "$out/$name.blend")
  rm -rf "${out:?}/$place/$name"
  within "$place" blender -b "$base/$name.blend" --python-exit-code 3 -P blender_export/export_aovs.py -- \
    --output "$base/$place/$name/$name.####.exr" --frames "${frame_of[$name]}" --masks disc:9 || return 1
  [ "$before" = "$(sha256sum "$out/$name.blend")" ] || { echo "the artist's file was changed"; return 1; }
}

comp_example() {
  "$kagefude" comp tests/quality/measure.toml "$out/$1/$2/$2.####.exr" -o "$out/$1/$2/comp.####.exr" \
    --progress none --set 'output.layers=["visibility.*"]'
}

build_program() {
  within "$1" cmake -S . -B /build/release -G Ninja -DCMAKE_BUILD_TYPE=Release -DKAGEFUDE_BENCH=OFF &&
    within "$1" nice cmake --build /build/release
}

comped_tests() {
  within "$1" env KAGEFUDE=/build/release/kagefude python3 -m unittest discover -s tests/blender_export -p 'comped_*.py'
}

unit_tests() { within "$1" ctest --test-dir /build/release --output-on-failure -j2; }

# All that can be done with the Blender of PLACE; what depends on a failed step is left out.
check_place() {
  local place=$1 name
  if [ "$place" != here ]; then
    step "$place" "making the root" make_root "$place" || return 0
    step "$place" "installing packages" install_packages "$place" || return 0
  fi
  within "$place" blender --version 2>/dev/null | sed -n '1s/Blender //p' >"$out/$place.version"
  step "$place" "exporter tests" exporter_tests "$place" || true
  for name in "${examples[@]}"; do
    step "$place" "exporting $name" export_example "$place" "$name" &&
      step "$place" "comping $name" comp_example "$place" "$name" || true
  done
  if [ "$place" != here ] && [ -n "$build" ]; then
    if step "$place" "building" build_program "$place"; then
      step "$place" "comped tests" comped_tests "$place" || true
      step "$place" "unit tests" unit_tests "$place" || true
    fi
  fi
}

mkdir -p "$out"
rm -f "$out"/*.version
for name in "${examples[@]}"; do
  step here "making $name" blender -b --factory-startup --python-exit-code 3 \
    -P "examples/$name.py" -- "$out/$name.full.blend" &&
    step here "shrinking $name" blender -b "$out/$name.full.blend" --python-exit-code 3 --python-expr \
      "import bpy; s = bpy.context.scene; s.render.resolution_percentage = 50; s.cycles.samples = 2; bpy.ops.wm.save_as_mainfile(filepath='$out/$name.blend')"
done
for place in here "${suites[@]}"; do check_place "$place"; done
echo
python3 tests/blender_export/versions_table.py "$kagefude" "$out" "${suites[@]}" ||
  failures+=("the table: a version differs by more than is allowed, or is missing")
for failure in ${failures[@]+"${failures[@]}"}; do echo "FAILED: $failure"; done
[ ${#failures[@]} -eq 0 ]
