#!/usr/bin/env bash
# kagefude live from outside: what its page gets, what everybody else is refused, an edit on disk, and
# the end by Ctrl-C and SIGTERM while somebody waits for a picture.
set -euo pipefail
. "$(dirname "$0")/frames.sh"

mkdir "$work/look"
printf '[[style]]\nstrip = "builtin:soft"\n' >"$work/look/look.toml"
start() {
  "$kagefude" live "$work/look/look.toml" "$data/shot.0001.exr" --no-open "$@" <&0 >"$work/address" 2>"$work/log" &
  program=$!
  for _ in $(seq 200); do
    [ -s "$work/address" ] && break
    sleep 0.05
  done
  address=$(head -1 "$work/address")
}

start
check "no address on the loopback: $address" grep -qE '^http://127\.0\.0\.1:[0-9]+/[0-9a-f]{32}/$' "$work/address"
check "$(cat "$work/log")" python3 tests/e2e/live_client.py "$address" "$work/look/look.toml"
first=$address

# Somebody waits for a picture that does not come.
python3 - "$address" <<'PY' &
import sys, urllib.request
try:
    urllib.request.urlopen(sys.argv[1] + "picture?seen=1000000&stage=result", timeout=60).read()
except OSError:
    pass
PY
waiter=$!
sleep 0.5
began=$SECONDS
kill -INT "$program"
code=0
wait "$program" || code=$?
check "Ctrl-C ended with $code" test "$code" -eq 130
check "the end took $((SECONDS - began)) s" test $((SECONDS - began)) -lt 4
wait "$waiter"

start
check "the same token twice" test "${first##*:}" != "${address##*:}"
kill -TERM "$program"
code=0
wait "$program" || code=$?
check "SIGTERM ended with $code" test "$code" -eq 143

# With the program that started it, however that ended.
mkfifo "$work/pipe"
sleep 60 >"$work/pipe" &
parent=$!
start --until-closed <"$work/pipe"
sleep 0.5
check "it ended before its parent" kill -0 "$program"
kill -KILL "$parent"
code=0
wait "$program" || code=$?
check "the end of standard input ended it with $code" test "$code" -eq 0

# What is wrong from the start ends the call.
code=0
printf '[brush]\ncontrst = 1\n' >"$work/look/wrong.toml"
"$kagefude" live "$work/look/wrong.toml" "$data/shot.0001.exr" --no-open >"$work/out" 2>"$work/log" || code=$?
check "a wrong look ended with $code" test "$code" -eq 2
check "a wrong look is not named" grep -q "wrong.toml:2" "$work/log"
summary
