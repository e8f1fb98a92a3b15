#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# interrupt.sh BUILD SOURCE: Ctrl-C in mid-run completes the outputs; a killed run leaves a recording behind.
set -eu
plumb=$1/bin/plumb pile=$2/samples/scenes/pile.json
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$plumb" run "$pile" --collider reference --quiet --duration 600 --out "$work/a.csv" --out "$work/a.html" --out "$work/a.plumb" \
  --summary "$work/a.json" 2>"$work/err" &
run=$!
sleep 2
kill -INT $run
code=0
wait $run || code=$?
cat "$work/err"
[ $code = 130 ]
grep -q "interrupted" "$work/err"
grep -q '"state_hash"' "$work/a.json"
grep -q "</html>" "$work/a.html"
[ "$(head -c 8 "$work/a.plumb")" = PLUMBREC ]

"$plumb" run "$pile" --collider reference --quiet --duration 600 --out "$work/b.plumb" &
run=$!
sleep 1.5
kill -KILL $run
wait $run || true
[ "$(head -c 8 "$work/b.plumb")" = PLUMBREC ]
"$plumb" export "$work/b.plumb" --out "$work/b.csv" --out "$work/b.html" | grep -q "frames"
grep -q "</html>" "$work/b.html"
[ "$(wc -l <"$work/b.csv")" -gt 2010 ]
