#!/usr/bin/env bash
# inspect, comp and sheet on files that nobody here wrote: a report or one sentence, never a crash,
# and nothing left behind. The files lie beside the checkout; without them the test is skipped.
set -euo pipefail
cd "$(dirname "$0")/../.."
kagefude=$PWD/build/release/kagefude
samples=$PWD/../shared/data
if [ ! -d "$samples" ]; then
  echo "skipped: no sample files beside the checkout"
  exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
failed=0
check() {  # FILE COMMAND...: exit code 0, 1 or 2, and an error is one line that names the file
  local file=$1 code=0
  shift
  timeout 60 "$@" >"$work/out.txt" 2>"$work/err.txt" || code=$?
  if [ "$code" -gt 2 ]; then
    echo "FAILED: exit $code: $*" >&2
    failed=$((failed + 1))
  elif [ "$code" -ne 0 ] && [ "$(grep -c '^ERROR: ' "$work/err.txt")" -ne 1 ]; then
    echo "FAILED: not one clear error: $*" >&2
    cat "$work/err.txt" >&2
    failed=$((failed + 1))
  elif [ "$code" -ne 0 ] && ! grep -qF "$(basename "$file")" "$work/err.txt"; then
    echo "FAILED: the error does not name $file" >&2
    failed=$((failed + 1))
  else
    passed=$((passed + 1))
  fi
}
while IFS= read -r file; do
  check "$file" "$kagefude" inspect "$file"
  check "$file" "$kagefude" comp "" "$file" -o "$work/made.exr" --progress none
  check "$file" "$kagefude" sheet "" "$file" -o "$work/made.png"
done < <(find "$samples" -type f ! -name '*.md' ! -name '*.json' | sort)
left=$(find "$work" -type f ! -name '*.txt')
[ -z "$left" ] || { echo "FAILED: left behind: $left" >&2; failed=$((failed + 1)); }
for file in "$samples"/cryptomatte/*.exr "$samples"/windows/*.exr; do
  "$kagefude" inspect "$file" --json | python3 -m json.tool >/dev/null && passed=$((passed + 1)) ||
    { echo "FAILED: no JSON for $file" >&2; failed=$((failed + 1)); }
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
