#!/usr/bin/env bash
# The report opened in headless Chromium with the network cut off: every thumbnail loads, plots are drawn,
# and a frame that pops is marked.    tests/e2e/report_page_long.sh [SCREENSHOT.png]
set -euo pipefail
screenshot=$(realpath -m "${1:-/dev/null}")
source "$(dirname "${BASH_SOURCE[0]}")/frames.sh"
skip() { echo "report_page_long.sh: skipped: $1"; exit 0; }
.ci/ensure_packages page || skip "Chromium cannot be installed here"

# 24 frames that move a little; frame 13 pops; frame 17 is broken; frame 20 warns.
mkdir "$work/in"
cp "$data/shot.Key.depth.0001.exr" "$work/in/"
command=(oiiotool "$data/shot.0001.exr")
for i in $(seq 24); do
  name=$(printf 'shot.%04d' "$i")
  left=$((20 + i))
  [ "$i" -ne 13 ] || left=90
  command+=(--dup --cut "128x72+$left+40" -o "$work/in/$name.exr" --pop)
  sed "s/shot.0001.exr/$name.exr/; s/\"frame\": 1,/\"frame\": $i,/" "$data/shot.0001.json" >"$work/in/$name.json"
done
"${command[@]}"
head -c 20000 "$work/in/shot.0017.exr" >"$work/cut" && cp "$work/cut" "$work/in/shot.0017.exr"
oiiotool "$work/in/shot.0020.exr" --cut 8x8+40+30 --mulc 1e38 --mulc 1e38 -o "$work/inf.exr"
oiiotool "$work/inf.exr" "$work/in/shot.0020.exr" --paste +40+30 -d float -o "$work/holes.exr"
mv "$work/holes.exr" "$work/in/shot.0020.exr"
printf '[[style]]\nobject = "Vase"\nstrip = "builtin:fine"\n' >"$work/look.toml"
code=$(exit_code "$kagefude" comp "$work/look.toml" "$work/in/shot.####.exr" -o "$work/out/shot.####.exr" \
  --skip-bad-frames --report "$work/report")
check "one bad frame: exit $code" test "$code" -eq 1

browser() {
  timeout 60 chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$work/profile" \
    --host-resolver-rules="MAP * ~NOTFOUND" --virtual-time-budget=4000 --window-size=1240,2400 "$@" 2>"$work/log"
}
# What the page is after it was laid out, told by the browser itself.
{
  sed 's/ loading="lazy"//g' "$work/report/index.html"
  cat <<'JS'
<script>
addEventListener("load", () => {
  const pictures = [...document.images];
  const loaded = pictures.filter(p => p.naturalWidth > 0).length;
  const wide = document.documentElement.scrollWidth <= innerWidth ? "fits" : "overflows";
  const strange = performance.getEntriesByType("resource").filter(r => !r.name.startsWith("file:")).length;
  document.body.textContent = `pictures ${loaded} of ${pictures.length}, wide ${wide}, requests ${strange}`;
});
</script>
JS
} >"$work/report/probe.html"
told=$(browser --dump-dom "file://$work/report/probe.html" | grep -oE 'pictures [0-9]+ of [^<]*' | head -1 || true)
echo "the browser tells: $told"
check "not all pictures load: $told" grep -q '^pictures 46 of 46, wide fits, requests 0' <<<"$told"
page=$(cat "$work/report/index.html")
for expected in '>13 jump<' '>17 failed<' 'taken as background (64 pixels)' '<path d=' 'strip = &quot;builtin:fine&quot;'; do
  check "the page lacks $expected" grep -qF -- "$expected" <<<"$page"
done
browser --screenshot="$work/page.png" "file://$work/report/index.html"
check "a screenshot that is not blank" test "$(oiiotool --stats "$work/page.png" | awk '/Stats StdDev/ {print ($3 > 5)}')" = 1
[ "$screenshot" = /dev/null ] || cp "$work/page.png" "$screenshot"
summary
