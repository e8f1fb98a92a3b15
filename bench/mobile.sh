#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bash bench/mobile.sh [BUILD [OUT.png]]: the mobile of 3 to 4095 joints on Plumb and ODE, as a table, ratios at 127 and
# 4095 joints, and a chart (with gnuplot-nox). Build with the preset dev.
set -eu
build=${1:-build/dev} png=${2:-mobile.png}
here=$(dirname "$0")
csv=$(mktemp)
trap 'rm -f "$csv"' EXIT
"$build/bin/bench_mobile" | tee "$csv"
for joints in 127 4095; do
  awk -F, -v joints=$joints '
    $1 == joints {ms[$2] = $3; gap[$2] = $4}
    END {
      ode = ms["ODE quick 5 iterations"]
      for (name in ms) printf "%d joints: %-26s %8.4f ms  %5.2f of ODE with 5 iterations, widest gap %s mm\n", joints, name, ms[name], ms[name] / ode, gap[name]
    }' "$csv" | sort -k4
done
gnuplot -e "csv='$csv'; png='$png'" "$here/mobile/chart.gp"
echo "wrote $png"
