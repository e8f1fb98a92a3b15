#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# readme.sh SOURCE BUILD: what README.md shows is there: its scene runs, its links lead somewhere, the program knows its
# options, and its exit codes are those that the program names.
set -eu
source=$1 plumb=$2/bin/plumb work=$2/readme-test readme=$1/README.md
fail() { echo "README.md: $1"; exit 1; }
rm -rf "$work" && mkdir -p "$work"

awk '/^```jsonc/ { inside = 1; next } /^```/ { inside = 0 } inside' "$readme" >"$work/scene.json"
[ -s "$work/scene.json" ] || fail "shows no scene"
"$plumb" run "$work/scene.json" --quiet --duration 0.1

links=$(grep -o '](\([^)]*\))' "$readme" | sed 's/^](//; s/)$//' | grep -v '^https:')
[ -n "$links" ] || fail "has no links"
for link in $links; do [ -e "$source/${link%%#*}" ] || fail "$link is not there"; done

for verb in run colliders effects check compare cost tune export; do "$plumb" "$verb" --help; done >"$work/help.txt"
options=$(awk '/^## The program/ { inside = 1; next } /^## / { inside = 0 } inside' "$readme" | grep -oE -- '--[a-z-]+' | sort -u)
[ -n "$options" ] || fail "names no options"
for option in $options; do grep -qE -- "(^|[ ,])$option( |$)" "$work/help.txt" || fail "the program has no $option"; done

codes() { tr '\n' ' ' | sed -n 's/.*Exit codes: \([^.]*\)\..*/\1/p' | grep -oE '(^|, *)[0-9]+' | grep -oE '[0-9]+' | tr '\n' ' '; }
named=$("$plumb" --help | codes)
shown=$(codes <"$readme")
[ -n "$named" ] && [ "$named" = "$shown" ] || fail "names the exit codes $shown, the program $named"
