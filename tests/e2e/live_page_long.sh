#!/usr/bin/env bash
# The page of kagefude live in headless Chromium: open, probe, turn, undo, click, strips, a dragged
# light, wipe, save, a broken look, edits on disk.    tests/e2e/live_page_long.sh [FOLDER for screenshots]
set -euo pipefail
pictures=$(realpath -m "${1:-build/page/pictures}")
source "$(dirname "${BASH_SOURCE[0]}")/frames.sh"
skip() { echo "live_page_long.sh: skipped: $1"; exit 0; }
.ci/ensure_packages page || skip "Chromium cannot be installed here"
# Debian's npm is a package of its own, others' Node.js brings it along.
command -v npm >/dev/null || .ci/ensure_packages npm || skip "npm cannot be installed here"

modules=build/page
mkdir -p "$modules" "$pictures"
if ! cmp -s tests/page/package-lock.json "$modules/package-lock.json" || [ ! -d "$modules/node_modules" ]; then
  cp tests/page/package.json tests/page/package-lock.json "$modules/"
  npm ci --prefix "$modules" --no-audit --no-fund >"$work/npm" 2>&1 ||
    { rm -rf "$modules/node_modules"; cat "$work/npm" >&2; skip "playwright-core cannot be had from npm here"; }
fi
KAGEFUDE=$kagefude DATA=$data CASTERS=$PWD/tests/data/casters MODULES=$(realpath "$modules/node_modules") PICTURES=$pictures \
  timeout 240 node --test tests/page/live_page_test.mjs >"$work/tap" 2>&1 && pass || { cat "$work/tap" >&2; fail "the page"; }
grep -E '^# (tests|pass) |^ℹ (tests|pass) ' "$work/tap"
summary
