#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# interrupt.sh BUILD SOURCE: Ctrl-C in mid-run completes the outputs; a killed run leaves a recording behind.
set -eu
plumb=$1/bin/plumb json_has=$1/bin/plumb_json_has pile=$2/samples/scenes/pile.json
work=$(mktemp -d)
run=
trap 'if [ -n "$run" ]; then kill -KILL $run || true; fi; rm -rf "$work"' EXIT

# grown FILE BYTES: waits until a run has written that much.
grown() {
  for _ in $(seq 600); do
    [ -f "$1" ] && [ "$(wc -c <"$1")" -gt "$2" ] && return
    sleep 0.1
  done
  echo "the run wrote nothing within a minute"
  return 1
}

"$plumb" run "$pile" --collider reference --quiet --duration 600 --out "$work/a.csv" --out "$work/a.html" --out "$work/a.plumb" \
  --summary "$work/a.json" 2>"$work/err" &
run=$!
grown "$work/a.plumb" 2000000
kill -INT $run
code=0
wait $run || code=$?
run=
cat "$work/err"
[ $code = 130 ]
grep -q "interrupted" "$work/err"
# the recording opens, whole, and the figures are those of the part that was run
"$json_has" "$work/a.json" /state_hash /speed/max /penetration/mean
[ "$("$json_has" "$work/a.json" --print /ended)" = '"interrupted"' ]
[ "$("$json_has" "$work/a.json" --print /steps)" -gt 10 ]
[ "$("$json_has" "$work/a.json" --print /speed/max)" != 0.0 ]
"$plumb" export "$work/a.plumb" --out "$work/again.csv" >"$work/frames" 2>"$work/err"
[ ! -s "$work/err" ]
cat "$work/frames"
cmp <(cut -d, -f1 "$work/a.csv") <(cut -d, -f1 "$work/again.csv")
grep -q "</html>" "$work/a.html"
[ "$(head -c 8 "$work/a.plumb")" = PLUMBREC ]

"$plumb" run "$pile" --collider reference --quiet --duration 600 --out "$work/b.plumb" &
run=$!
grown "$work/b.plumb" 1000000
kill -KILL $run
wait $run || true
run=
[ "$(head -c 8 "$work/b.plumb")" = PLUMBREC ]
"$plumb" export "$work/b.plumb" --out "$work/b.csv" --out "$work/b.html" | grep -q "frames"
grep -q "</html>" "$work/b.html"
[ "$(wc -l <"$work/b.csv")" -gt 2010 ]
