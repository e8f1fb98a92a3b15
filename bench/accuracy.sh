#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Error against CPU time of Plumb and of the other engines on the cases of the study, in turn on one machine.
#   bash bench/accuracy.sh BUILD OUT_DIR [CASE ...]
# BUDGET: time for Plumb's runs of a case (60s unless set). LIMIT: seconds that one run of a peer may take (5 unless set).
set -euo pipefail
[ $# -ge 2 ] || { sed -n '3,5s/^# *//p' "$0"; exit 2; }
here=$(dirname "$(realpath "$0")") build=$1 out=$2
shift 2
mkdir -p "$out/plumb"
cases=("$@")
[ ${#cases[@]} -gt 0 ] || mapfile -t cases < <("$build/bin/plumb" cost --list | awk '{print $1}')
for case in "${cases[@]}"; do
  echo "$case" >&2
  rm -rf "$out/plumb/$case"
  "$build/bin/plumb" cost "$case" --quiet --repeats 3 --budget "${BUDGET:-60s}" --out "$out/plumb/$case" > /dev/null
  for peer in "$build"/bin/accuracy_*; do
    "$peer" --limit "${LIMIT:-5}" "$case" > "$out/$case.$(basename "$peer").csv"
  done
done
python3 "$here/accuracy/table.py" "$out" "${cases[@]}" | tee "$out/table.txt"
gnuplot "$out/chart.gp"
echo "$out/accuracy.svg" >&2
