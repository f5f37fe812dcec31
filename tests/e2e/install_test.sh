#!/usr/bin/env bash
# What `cmake --install` puts into a prefix works from there and after a move: the program finds its
# worker, the manual pages and the completion know every option and key, and a program of somebody
# else's comps an image buffer with the installed library as the command does the file.
set -euo pipefail
source "$(dirname "$0")/frames.sh"
top=$PWD
cmake --install build/release --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix"
cd "$work"
installed=$work/prefix/bin/kagefude
check "the worker lies beside the program" test ! -e prefix/bin/kagefude-oiio
make_frames in 1
"$kagefude" strip make strip.png >/dev/null
oiiotool strip.png -o strip.tif
printf '[output]\nlayers = ["visibility.*"]\ncolour = "float"\n[[style]]\nobject = "*"\nstrip = "strip.tif"\n' >look.toml
comp() { "$1" comp look.toml in/shot.0001.exr -o "$2" --progress none; }
comp "$kagefude" built.exr
comp "$installed" installed.exr
check "the installed program makes another file" cmp -s built.exr installed.exr

man1=$(zcat prefix/share/man/man1/kagefude.1.gz | sed 's/\\-/-/g')
for option in --existing --preview-format --skip-bad-frames --against --tile; do
  check "the manual page lacks $option" grep -qF -- "$option" <<<"$man1"
done
check "the manual page shows what is hidden" test -z "$(grep '^\.SS "document' <<<"$man1" || true)"
man5=$(zcat prefix/share/man/man5/kagefude-look.5.gz | sed 's/\\-/-/g')
"$installed" passes --json | python3 -c '
import json, sys
for table in json.load(sys.stdin):
    print("SECTION", table["pass"])
    for parameter in table["parameters"]: print(parameter["name"])' >keys
while read -r word name; do
  if [ "$word" = SECTION ]; then wanted=".SH [$name]"; else wanted="\\fB$word\\fR = "; fi
  grep -qF -- "$wanted" <<<"$man5" || { fail "the look's page lacks $word $name"; break; }
done <keys
pass
if command -v groff >/dev/null; then
  for page in man1/kagefude.1 man5/kagefude-look.5; do
    check "$page is no clean page" test -z "$(zcat prefix/share/man/$page.gz | groff -man -ww -z 2>&1)"
  done
fi

# complete WORD...: what bash would offer for the last word.
complete_words() {
  bash -c 'source prefix/share/bash-completion/completions/kagefude
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); COMPREPLY=(); _kagefude; echo "${COMPREPLY[*]}"' bash "$@"
}
offers() { # WANTED WORD...
  local got
  got=$(complete_words "${@:2}")
  [ "$got" = "$1" ] && pass || fail "bash offers \"$got\" for ${*:2}"
}
offers "comp compare" kagefude comp
offers "--existing" kagefude comp --ex
offers "overwrite skip update" kagefude comp --existing ""
offers "tone.gamma=" kagefude comp --set tone.ga
offers "zips zip" kagefude comp --set output.compression = zi
offers "true false" kagefude comp --set output.passthrough =
offers "make" kagefude strip ma
offers "" kagefude comp lo

# Somebody else's program; what it multiplies by is a power of two and a half, so the values agree.
sed -n '/^#include/,$p' "$top/examples/library/comp_buffer.cpp" >lines
check "the example has 30 lines or more" test "$(wc -l <lines)" -lt 30
cmake -S "$top/examples/library" -B other -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release >log 2>&1 &&
  cmake --build other >>log 2>&1 || { cat log >&2; fail "the example does not build"; }
sed 's/strip.tif/builtin:fine/' look.toml >fine.toml
"$kagefude" comp fine.toml in/shot.0001.exr -o file.exr --progress none
oiiotool file.exr --mulc 1.5,1.5,1.5,1 -d float -o bright.exr 2>/dev/null
other/comp_buffer fine.toml in/shot.0001.exr buffer.exr 2>said && pass || fail "the example fails: $(cat said)"
idiff -q -fail 0 -warn 0 buffer.exr bright.exr >/dev/null && pass || fail "the buffer's comp differs from the file's"
check "the buffer has another window" test "$(oiiotool --info -v buffer.exr | grep -E 'origin|full')" = "$(oiiotool --info -v file.exr | grep -E 'origin|full')"
summary
