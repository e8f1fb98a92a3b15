#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# outputs.sh BUILD SOURCE: a run writes every kind of file; a summary on stdout is JSON with the promised fields; the
# same command gives the same bits; the sample scenes are sound.
set -eu
plumb=$1/bin/plumb scenes=$2/samples/scenes small=$2/tests/structure/small_pile.json
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for scene in "$scenes"/*.json; do "$plumb" check "$scene"; done

"$plumb" run "$small" --quiet --out "$work/x.html" --out "$work/x.png" --out "$work/x.csv" --out "$work/x.plumb" --summary - >"$work/summary.json"
for file in html png csv plumb; do [ -s "$work/x.$file" ]; done
for field in scene collider method precision threads lanes dt substeps velocity_iterations position_iterations steps \
  simulated_time bodies particles joints contacts time_ms energy momentum penetration joint_error speed clamps state_hash effects; do
  grep -q "\"$field\":" "$work/summary.json" || { echo "the summary lacks $field"; exit 1; }
done

hash_of() { "$plumb" run "$small" --quiet --collider reference --summary - "$@" | grep state_hash; }
first=$(hash_of)
[ "$first" = "$(hash_of)" ]
[ "$first" = "$(hash_of --threads 2)" ]
[ "$first" = "$(hash_of --threads 4 --lanes 4)" ]
[ "$first" = "$(hash_of --lanes 1)" ]
[ "$first" != "$(hash_of --precision double)" ]

"$plumb" effects "$scenes/bounce.json" | grep -q "restitution.*yes"
"$plumb" effects "$scenes/pile.json" --duration 1 | grep -q "restitution.*no"
