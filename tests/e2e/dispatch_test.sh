#!/usr/bin/env bash
# The vector code of every level gives the same files, bit for bit: plain, AVX2, and what the
# program picks for this machine; with one thread and with two.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$PWD/build/release
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
passed=0

programs=(kagefude kagefude_plain)
if grep -qw avx2 /proc/cpuinfo; then programs+=(kagefude_avx2); else echo "no AVX2 here: that level is skipped"; fi
cp -r tests/data/still tests/data/casters "$work/"

cat >"$work/look.toml" <<'LOOK'
[output]
layers = ["visibility.*", "confidence.*", "brush.*", "outline", "surface.id"]
[[style]]
object = ["Vase", "Bowl"]
strip = "builtin:fine"
brush.mapping = "polar"
LOOK

# same FRAME OPTION …: comps the frame with every program and compares the files.
same() {
  local frame=$1 first=
  shift
  for program in "${programs[@]}"; do
    for threads in 1 2; do
      local out="$work/$program.$threads.exr"
      "$build/$program" comp "$work/look.toml" "$work/$frame" -o "$out" --progress none \
        --threads $threads "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
      if [ -z "$first" ]; then
        first=$out
      elif cmp -s "$first" "$out"; then
        passed=$((passed + 1))
      else
        echo "FAILED: $program with $threads threads gives another file ($frame $*)" >&2
        failed=$((failed + 1))
      fi
    done
  done
}

same still/shot.0001.exr
same still/shot.0001.exr --set brush.mapping=seed --set smooth.h=9
for method in pcf pcss; do same still/shot.0001.exr --set shadow.method=$method; done
for method in coverage volume places; do
  same casters/shot.0001.exr --set shadow.method=$method
done

echo "dispatch: $passed passed, $failed failed"
[ $failed -eq 0 ]
