#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bash bench/modes.sh [BUILD [OUT.png]]: by what factor a small disturbance of stacked cubes and of a table grows in a
# step, over methods, steps, substeps and iterations: a table, the worst of each method, and a chart (with gnuplot-nox).
# Build with the preset dev.
set -eu
build=${1:-build/dev} png=${2:-modes.png}
here=$(dirname "$0")
csv=$(mktemp)
trap 'rm -f "$csv"' EXIT
"$build/bin/bench_modes" "$build/lib/plumb/plugins" | tee "$csv"
awk -F, 'NR > 1 && !($6 <= worst[$1 ", " $2]) {worst[$1 ", " $2] = $6; at[$1 ", " $2] = $3 " ms, " $4 " x (" $5 " + " $5 ")"}
  END {for (name in worst) printf "%-20s grows by at most %.4f a step (%s)\n", name, worst[name], at[name]}' "$csv" | sort
gnuplot -e "csv='$csv'; png='$png'" "$here/modes/chart.gp"
echo "wrote $png"
