#!/usr/bin/env bash
# --max-memory holds: the peak of a whole run stays below the bound and what the program itself needs,
# with few and with many channels, and with room for one frame or for several.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/frames.sh"
program=64 # MiB: code, libraries, two strips, thread stacks
mkdir "$work/in"
oiiotool "$data/shot.0001.exr" --resample 1280x720 -o "$work/in/shot.0001.exr"
cp "$data/shot.0001.json" "$data/shot.Key.depth.0001.exr" "$work/in/"
for i in 2 3 4 5 6; do
  ln "$work/in/shot.0001.exr" "$work/in/shot.000$i.exr"
  cp "$work/in/shot.0001.json" "$work/in/shot.000$i.json"
done
echo >"$work/plain.toml"
printf '[output]\nlayers = ["*"]\npassthrough = true\n' >"$work/all.toml"
cat >"$work/peak.py" <<'PY'
import resource, subprocess, sys
code = subprocess.run(sys.argv[1:], stderr=subprocess.DEVNULL).returncode
print(code, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024)
PY
for look in plain all; do
  for bound in 320 520 900; do
    [ "$look$bound" != all320 ] || continue
    read -r code peak < <(python3 "$work/peak.py" "$kagefude" comp "$work/$look.toml" "$work/in/shot.####.exr" \
      -o "$work/out/shot.####.exr" --threads 4 --max-memory "${bound}M" --progress none --preview "$work/out")
    echo "$look, $bound MiB allowed: $peak MiB"
    check "$look with ${bound}M: exit $code" test "$code" -eq 0
    check "$look with ${bound}M: $peak MiB" test "$peak" -le $((bound + program))
  done
done
code=$(exit_code "$kagefude" comp "$work/all.toml" "$work/in/shot.####.exr" -o "$work/none/shot.####.exr" --max-memory 100M)
check "too little memory: exit $code" test "$code" -eq 1
check "names what is needed" grep -q '^ERROR: frame 1: it needs about .* MiB, more than --max-memory 100' "$work/log"
summary
