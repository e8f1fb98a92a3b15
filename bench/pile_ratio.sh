#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bash bench/pile_ratio.sh [BUILD] [ROUNDS]: Plumb and its peers on the pile, in turn in one run, one thread each.
#
# Plumb's solver time is all of the step outside of the collider's calls. Medians over the rounds are printed, and
# ratios against Bullet with 10 iterations.
set -eu
build=${1:-build/dev} rounds=${2:-3}
pile=$(dirname "$0")/../samples/scenes/pile.json
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Median of the solver's times in the second half of the run [ms], from the summary.
plumb_solve() { "$build/bin/plumb" run "$pile" --collider ode --quiet --summary - "$@" |
  sed -n '/"solve"/,/}/s/.*"median": \([0-9.]*\).*/\1/p'; }
peer_solve() { sed 's/.*solve \([0-9.]*\) ms.*/\1/'; }
median() { sort -n "$1" | awk '{v[NR] = $1} END {print v[int((NR + 1) / 2)]}'; }

for _ in $(seq "$rounds"); do
  "$build/bin/peer_bullet" "$pile" 10 | tee /dev/stderr | peer_solve >>"$work/bullet"
  plumb_solve >>"$work/widest"
  "$build/bin/peer_ode" "$pile" 10 | tee /dev/stderr | peer_solve >>"$work/ode"
  plumb_solve --lanes 4 >>"$work/four"
  plumb_solve --precision double >>"$work/double"
done

bullet=$(median "$work/bullet")
echo "solver, ms a step (medians of $rounds rounds; flags: $(grep -h CMAKE_CXX_FLAGS_RELWITHDEBINFO:\\\|CMAKE_BUILD_TYPE: "$build/CMakeCache.txt" | tr '\n' ' '))"
for name in bullet ode widest four double; do
  case $name in
    bullet) label="Bullet, 10 iterations" ;; ode) label="ODE quick step, 10 iterations" ;;
    widest) label="Plumb 5 + 5, widest lanes" ;; four) label="Plumb 5 + 5, 4 lanes (SSE2)" ;;
    double) label="Plumb 5 + 5, double precision" ;;
  esac
  awk -v label="$label" -v v="$(median "$work/$name")" -v b="$bullet" 'BEGIN {printf "  %-32s %7.3f   ratio %.3f\n", label, v, v / b}'
done
