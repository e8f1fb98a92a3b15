#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# cost.sh BUILD SOURCE: plumb cost and plumb tune as a user meets them: files, parts, a killed sweep, bad input.
set -u
plumb=$1/bin/plumb scenes=$2/samples/scenes
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# expect CODE WORDS COMMAND…: the command ends with the code and says one line that holds the words.
expect() {
  local code=$1 words=$2
  shift 2
  "$@" >"$work/out" 2>"$work/err"
  local got=$?
  if [ $got != "$code" ] || [ "$(wc -l <"$work/err")" != 1 ] || ! grep -qF -- "$words" "$work/err"; then
    fail "$* -> exit $got (wanted $code), said: $(cat "$work/err") (wanted one line with \"$words\")"
  fi
}

# What a table says, times aside.
table() { cut -d, -f1-12 "$1/points.csv"; }

sweep=("$plumb" cost pendulum --curves pbd --repeats 1 --budget 10m --quiet)
"${sweep[@]}" --out "$work/whole" >"$work/said" 2>"$work/err" || fail "a sweep ended with $?: $(cat "$work/err")"
grep -q "costs .* µs of CPU a simulated second" "$work/said" || fail "no sentence about the cost: $(cat "$work/said")"
for file in points.csv findings.json report.html runs.csv study.json charts/pendulum.dat charts/pendulum.gp; do
  [ -s "$work/whole/$file" ] || fail "there is no $file"
done
grep -q '"status": "not run"' "$work/whole/findings.json" && fail "points were not run within ten minutes"

# Killed on the way, and gone on with.
"${sweep[@]}" --out "$work/killed" >/dev/null 2>&1 &
victim=$!
for _ in $(seq 600); do [ "$(wc -l 2>/dev/null <"$work/killed/runs.csv")" -gt 8 ] 2>/dev/null && break; sleep 0.05; done
kill -9 $victim
wait $victim 2>/dev/null
[ -e "$work/killed/points.csv" ] && fail "it had ended before it was killed"
"${sweep[@]}" --out "$work/killed" >/dev/null 2>&1 || fail "a killed sweep does not go on"
[ "$(table "$work/whole")" = "$(table "$work/killed")" ] || fail "a killed and resumed sweep has another table"

for i in 1 2 3 4; do "${sweep[@]}" --out "$work/part$i" --shard $i/4 >/dev/null 2>&1 || fail "part $i ended with $?"; done
"$plumb" cost --merge "$work/part1" "$work/part2" "$work/part3" "$work/part4" --out "$work/merged" >/dev/null 2>&1 ||
  fail "parts cannot be merged"
[ "$(table "$work/whole")" = "$(table "$work/merged")" ] || fail "four parts make another table"
"${sweep[@]}" --out "$work/part5" --shard 1/4 2>&1 | grep -q ", 0 were not run; .* are for other parts" ||
  fail "a part misses the points of others"
expect 2 "--curves excludes --merge" "$plumb" cost --merge "$work/part1" --out "$work/x" --curves pbd

expect 2 "--out is required" "$plumb" cost pendulum
expect 2 'did you mean "pendulum"' "$plumb" cost pendulm --out "$work/x"
expect 2 "--shard 5/4: must be I/N" "$plumb" cost pendulum --out "$work/x" --shard 5/4
expect 2 "--budget soon: must be a time" "$plumb" cost pendulum --out "$work/x" --budget soon
expect 2 "--metric anle: pendulum has angle" "$plumb" cost pendulum --out "$work/x" --metric anle
expect 2 "--curves pdb: there is no such curve" "$plumb" cost pendulum --out "$work/x" --curves pdb
expect 6 "holds another sweep" "$plumb" cost parabola --out "$work/whole"
expect 6 "holds another sweep" "$plumb" cost --merge "$work/part1" --out "$work/whole"
expect 3 "holds no sweep" "$plumb" cost --merge "$work" --out "$work/x"
expect 6 "cannot be made" "$plumb" cost pendulum --out /proc/nowhere
expect 3 "absent.json" "$plumb" cost "$work/absent.json" --out "$work/x"
expect 4 "odd" "$plumb" cost stack --colliders odd --out "$work/x"
"$plumb" cost pendulum --out "$work/poor" --budget 0.000001s >/dev/null 2>"$work/err"
[ $? = 2 ] && grep -q "too small for a single point" "$work/err" || fail "a budget too small: $(cat "$work/err")"

"$plumb" tune pendulum --error 0.002 --quiet >"$work/settings" 2>"$work/err" || fail "tune: $(cat "$work/err")"
(printf '{'; cat "$work/settings"; printf ', "bodies": []}') >"$work/pasted.json"
"$plumb" check "$work/pasted.json" >/dev/null 2>&1 || fail "tuned settings cannot be pasted: $(cat "$work/settings")"
"$plumb" cost pendulum "$scenes/pile.json" --curves pbd --repeats 1 --budget 8s --quiet --out "$work/rest" >/dev/null 2>"$work/err" ||
  fail "one scene ends a sweep: $(cat "$work/err")"
grep -q "left out: .*pile.* takes longer" "$work/err" || fail "what was left out: $(cat "$work/err")"
expect 2 "was over before all was tried" "$plumb" tune stack --error 1e-300 --budget 0.05s --quiet
expect 2 "--error or --time is required" "$plumb" tune pendulum
expect 2 "the least error was" "$plumb" tune pendulum --error 1e-300 --quiet
expect 2 "ask for at least" "$plumb" tune "$scenes/bounce.json" --error 1e-30 --budget 8s --quiet
expect 3 "absent.json" "$plumb" tune "$work/absent.json" --error 1

[ $failures = 0 ]
