#!/usr/bin/env bash
# Looks out of the box, strips from pictures and palettes, looks compared: on the still life, in one command each.
set -euo pipefail
. "$(dirname "$0")/frames.sh"

frame=$data/shot.0001.exr
presets=(oil gouache cel ink pastel watercolour)
says() { # says FILE TEXT...: every text is in the file
  local file=$1 text
  shift
  for text in "$@"; do check "not said: $text (but: $(head -c 400 "$file"))" grep -qF -- "$text" "$file"; done
}
checked() { "$kagefude" look check "$@" >"$work/checked" 2>&1 || { grep problem "$work/checked" >&2; return 1; }; }
quiet() { "$@" >"$work/quiet" 2>&1; }
# refused CODE PART COMMAND...: that exit code, one line of error, which holds the part.
refused() {
  local code=$1 part=$2
  shift 2
  check "$* ends with another code" [ "$(exit_code "$@")" = "$code" ]
  check "$* says $(head -c 300 "$work/log"), not $part" grep -q "^ERROR: .*$part" "$work/log"
}

# Every preset: a look that comps, strips that pass their check, a picture of the frame's size; no two alike.
for preset in "${presets[@]}"; do
  "$kagefude" look new "$frame" -o "$work/looks/$preset.toml" --preset "$preset" \
    --preview "$work/$preset.png" >"$work/text" 2>"$work/log"
  says "$work/text" "$preset.toml: " "$preset.png: "
  check "$preset: its look does not comp" "$kagefude" comp "$work/looks/$preset.toml" "$frame" \
    -o "$work/comp/shot.0001.exr" --preview "$work/comp" --progress none
  check "$preset: the preview is not what comp makes" quiet oiiotool "$work/$preset.png" "$work/comp/shot.0001.png" --diff
  check "$preset: its look does not pass its own check" checked "$work/looks/$preset.toml" "$frame"
  for strip in "$work/looks/${preset}_strips"/*.png; do
    check "$strip is not fit to paint with" quiet "$kagefude" strip check "$strip"
  done
done
check "two presets give one picture" [ "$(md5sum "$work"/*.png | cut -d' ' -f1 | sort -u | wc -l)" = 6 ]

# The same frame, the same bytes.
"$kagefude" look new "$frame" -o "$work/again/oil.toml" --preset oil >/dev/null 2>&1
check "the same frame gives another look" same_files "$work/again/oil_strips" "$work/looks/oil_strips"
check "the same frame gives another look" cmp -s "$work/again/oil.toml" "$work/looks/oil.toml"

# Nobody's work is written over, and nothing is left half done.
echo mine >"$work/mine.toml"
refused 2 "is there already" "$kagefude" look new "$frame" -o "$work/mine.toml" --preset cel
check "the look was touched" [ "$(cat "$work/mine.toml")" = mine ]
echo mine >"$work/mine.png"
refused 2 "mine.png is there already" "$kagefude" look new "$frame" -o "$work/none.toml" --preset cel --preview "$work/mine.png"
check "the picture was touched" [ "$(cat "$work/mine.png")" = mine ]
rm "$work/mine.png"
refused 2 "folder of the look's strips" "$kagefude" look new "$frame" -o "$work/none.toml" --preset cel \
  --preview "$work/none_strips/a.png"
mkdir "$work/strips_only_strips"
refused 2 "is there already" "$kagefude" look new "$frame" -o "$work/strips_only.toml" --preset cel
echo kept >"$work/looks/cel_strips/own.txt"
check "--force fails" quiet "$kagefude" look new "$frame" -o "$work/looks/cel.toml" --preset cel --force
check "--force takes others' files away" [ "$(cat "$work/looks/cel_strips/own.txt")" = kept ]
refused 1 "cannot be read" "$kagefude" look new "$work/none.exr" -o "$work/none.toml" --preset cel
refused 2 "preset" "$kagefude" look new "$frame" -o "$work/none.toml" --preset acrylic
refused 2 "no key contrst" "$kagefude" look new "$frame" -o "$work/none.toml" --preset cel --set brush.contrst=1
check "--preview makes no folder" quiet "$kagefude" look new "$frame" -o "$work/deep.toml" --preset cel --preview "$work/a/b/c.png"
check "something was left" [ -z "$(find "$work" -name 'none*' -o -name '.*.new' -o -name '.*.tmp')" ]
check "--set fails" quiet "$kagefude" look new "$frame" -o "$work/set.toml" --preset oil --set brush.contrast=0.5
check "--set is not in the look" grep -q "^contrast = 0.5" "$work/set.toml"

# A full disk, or a preview that fails, leaves nothing that would stand in the way of the next try.
nothing_but_fill() { [ -z "$(find "$1" -mindepth 1 ! -name fill)" ]; }
if [ "$(id -u)" -eq 0 ] && mkdir "$work/small" && mount -t tmpfs -o size=1m tmpfs "$work/small" 2>/dev/null; then
  for room in 0 4 16 64 128 256 400; do
    head -c $((1024 * (1024 - room) - 4096)) /dev/zero >"$work/small/fill" || true
    code=$(exit_code "$kagefude" look new "$frame" -o "$work/small/l.toml" --preset cel --preview "$work/small/p.png")
    if [ "$code" = 0 ]; then rm -rf "$work/small"/[!f]*; fi
    check "a full disk ($room KiB left) ends with $code: $(head -c 300 "$work/log")" [ "$code" -le 1 ]
    check "a full disk ($room KiB left) keeps $(ls -A "$work/small")" nothing_but_fill "$work/small"
  done
  rm "$work/small/fill"
  check "the disk's own error is not the cause" quiet "$kagefude" look new "$frame" -o "$work/small/l.toml" --preset cel
  cp -r "$work/small" "$work/small_before"
  head -c 2000000 /dev/zero >"$work/small/fill" 2>/dev/null || true
  refused 1 "No space left" "$kagefude" look new "$frame" -o "$work/small/l.toml" --preset oil --force
  rm "$work/small/fill"
  check "--force on a full disk harms the look that is there" same_files "$work/small" "$work/small_before"
  umount "$work/small"
fi

# An interrupt takes away what is half written.
for signal in INT TERM HUP; do
  for delay in 0.02 0.1 0.3; do
    mkdir "$work/cut"
    env --default-signal "$kagefude" strip make "$work/cut/k.png" --set width=1024 --set height=1024 >/dev/null 2>&1 &
    sleep "$delay"
    kill -"$signal" $! 2>/dev/null || true
    wait $! || true
    env --default-signal "$kagefude" look new "$frame" -o "$work/cut/l.toml" --preset oil >/dev/null 2>&1 &
    sleep "$delay"
    kill -"$signal" $! 2>/dev/null || true
    wait $! || true
    check "SIG$signal after $delay s leaves $(ls -A "$work/cut")" [ -z "$(find "$work/cut" -name '.*' ! -path "$work/cut")" ]
    check "SIG$signal after $delay s leaves half a look" test -e "$work/cut/l.toml" -o ! -e "$work/cut/l_strips"
    rm -r "$work/cut"
  done
done

# Without albedo colours come from the picture, and that is said.
oiiotool "$frame" --ch "$(oiiotool --info -v "$frame" | sed -n 's/.*channel list: //p' | tr ',' '\n' |
  sed 's/^ *//; s/ (.*//' | grep -v DiffCol | paste -sd,)" -o "$work/bare/shot.0001.exr" 2>/dev/null || true
if [ -f "$work/bare/shot.0001.exr" ]; then
  cp "$data"/shot.0001.json "$work/bare/"; cp "$data"/shot.Key.depth.0001.exr "$work/bare/"
  "$kagefude" look new "$work/bare/shot.0001.exr" -o "$work/bare/l.toml" --preset oil >/dev/null 2>"$work/text"
  says "$work/text" "no diffuse colour" "from the picture"
  check "the look does not say so" grep -q "as the picture shows it" "$work/bare/l.toml"
fi

# Looks side by side.
"$kagefude" sheet --looks "$work/looks" "$frame" -o "$work/sheet.png" 2>/dev/null
check "the sheet is not three by two" [ "$(oiiotool --info "$work/sheet.png" | grep -o '[0-9]* x *[0-9]*' | head -1 |
  awk '{print ($1 > $3) ? "wide" : "high"}')" = wide ]
echo mine >"$work/sheet.png"
check "a sheet is not made anew" quiet "$kagefude" sheet --looks "$work/looks" "$frame" -o "$work/sheet.png"
check "a sheet is not made anew" quiet oiiotool --info "$work/sheet.png"
refused 2 "no look" "$kagefude" sheet --looks "$data" "$frame" -o "$work/s.png"
refused 2 "leave the look out" "$kagefude" sheet --looks "$work/looks" "$work/looks/oil.toml" "$frame" -o "$work/s.png"
refused 2 "needs a look and a frame" "$kagefude" sheet "$frame" -o "$work/s.png"

# What in a look does nothing.
printf '[brush]\npole_fade = 1\n[tone]\ngamma = 1.5\n[[style]]\nobject = "Pera"\n' >"$work/idle.toml"
check "idle keys end well" [ "$(exit_code "$kagefude" look check "$work/idle.toml" "$frame")" = 1 ]
says "$work/log" "brush.pole_fade changes nothing" "style 1 fits nothing" "2 of its entries"
check "tone.gamma is called idle" [ "$(grep -c gamma "$work/log")" = 0 ]
printf '[tone]\ngamma = 1.5\n' >"$work/busy.toml"
check "a busy key is called idle" quiet "$kagefude" look check "$work/busy.toml" "$frame"

# Strips from pictures and palettes.
"$kagefude" strip make "$work/from.png" --from "$work/oil.png" --patch 20,20,120,60 >/dev/null
check "the picture's strip is not fit to paint with" quiet "$kagefude" strip check "$work/from.png"
refused 2 "is not inside" "$kagefude" strip make "$work/x.png" --from "$work/oil.png" --patch 20,20,9000,60
refused 2 "come from the picture" "$kagefude" strip make "$work/x.png" --from "$work/oil.png" --set bristle=1
refused 1 "does not exist" "$kagefude" strip make "$work/x.png" --from "$work/none.jpg"
printf 'GIMP Palette\n#\n43 29 56 dark\n242 227 194 light\n138 51 36 mid\n' >"$work/p.gpl"
"$kagefude" strip make "$work/palette.png" --palette "$work/p.gpl" --set hue_shift=20 >/dev/null
check "the palette's strip is not fit to paint with" quiet "$kagefude" strip check "$work/palette.png"
"$kagefude" strip make "$work/colours.png" --palette "#2b1d38,#8a3324,#f2e3c2" --set hue_shift=20 >/dev/null
check "the same colours give another strip" cmp -s "$work/palette.png" "$work/colours.png"
echo mine >"$work/mine.png"
refused 2 "mine.png is there already" "$kagefude" strip make "$work/mine.png"
refused 2 "mine.png is there already" "$kagefude" strip make "$work/mine.png" --palette "$work/p.gpl"
check "a strip was written over" [ "$(cat "$work/mine.png")" = mine ]
ln -s "$work/nowhere.png" "$work/link.png"
refused 2 "link.png is there already" "$kagefude" strip make "$work/link.png"
check "strip make --force fails" quiet "$kagefude" strip make "$work/mine.png" --palette "$work/p.gpl" --set hue_shift=20 --force
check "--force does not write" cmp -s "$work/mine.png" "$work/palette.png"
rm "$work/mine.png" "$work/link.png"
printf 'GIMP Palette\n#\n43 29\n' >"$work/bad.gpl"
refused 1 "line 3" "$kagefude" strip make "$work/x.png" --palette "$work/bad.gpl"
refused 2 "is no colour" "$kagefude" strip make "$work/x.png" --palette "#12,#345678"
refused 2 "nothing between two commas" "$kagefude" strip make "$work/x.png" --palette "#2b1d38,,#ffffff"
refused 2 "--set width: strip.width wants" "$kagefude" strip make "$work/x.png" --set 'width=8;height=8'
refused 2 "more than one value" "$kagefude" strip make "$work/x.png" --set $'width=8\nheight=8'
check "a refused strip was written" [ ! -e "$work/x.png" ]
summary
