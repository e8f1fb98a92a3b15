#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# endings.sh BUILD SOURCE BAD_PLUGINS: runs that go wrong on the way end in order, with their exit code, one sentence, and their outputs.
set -u
plumb=$1/bin/plumb json_has=$1/bin/plumb_json_has source=$2 failing=$1/lib/plumb/failing_plugins bad=$3
spinner=$source/samples/scenes/spinner.json small=$source/tests/structure/small_pile.json
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# ends CODE WORDS OPTIONS…: a run ends with the code, says at most one line and the words, and completes its outputs.
ends() {
  local code=$1 words=$2 got
  shift 2
  "$plumb" run "$@" --quiet --out "$work/a.plumb" --out "$work/a.html" --summary "$work/a.json" 2>"$work/err"
  got=$?
  echo "$got: $(cat "$work/err")"
  [ $got = "$code" ] || fail "$* -> exit $got, wanted $code"
  [ "$(wc -l <"$work/err")" -le 1 ] || fail "$* said more than one line"
  grep -qF -- "$words" "$work/err" || [ -z "$words" ] || fail "$* did not say \"$words\""
  "$json_has" "$work/a.json" /state_hash /steps || fail "$* left no summary"
  grep -q "</html>" "$work/a.html" || fail "$* left no replay"
  "$plumb" export "$work/a.plumb" --out "$work/a.csv" >"$work/frames" || fail "$* left no recording"
  if grep -qiE 'nan|inf' "$work/a.csv"; then fail "$* recorded what is no number"; fi
}

# An explicit gyroscopic term gains energy, the faster the longer the step.
ends 5 "energy" "$spinner" --collider reference --set gyroscopic=explicit --dt 0.01 --duration 20
ends 5 "no longer finite" "$spinner" --collider reference --set gyroscopic=explicit --dt 0.2 --duration 20
ends 0 "" "$spinner" --collider reference --duration 20

# So it does beside what is made of particles. What pumps, draws together or pushes out is no divergence.
beside=$source/tests/app/scenes/spinner_and_rope.json
ends 5 "energy" "$beside" --collider reference --set gyroscopic=explicit
ends 0 "" "$beside" --collider reference
ends 0 "" "$source/samples/scenes/balloons.json" --collider ode --duration 2

# Energy that the pushing out of overlap gives is no divergence.
ends 0 "" "$source/tests/app/scenes/deep_overlap.json" --collider reference
ends 0 "" "$source/tests/app/scenes/deep_overlap.json" --collider ode --substeps 4

# Nor is what motors and springs give.
ends 0 "" "$source/samples/scenes/linkage.json" --collider reference --duration 3
ends 0 "" "$source/samples/scenes/car.json" --collider ode --duration 3

# A collider that fails now and then is told of, and counted; one that goes on failing ends the run.
ends 0 'collider "hiccup" failed in 14 of 100 steps: made to fail' "$small" --collider hiccup --plugin-path "$failing" --duration 1
[ "$("$json_has" "$work/a.json" --print /clamps/collider_failures)" = 14 ] || fail "failures were not counted"
ends 4 'collider "failing"' "$small" --collider failing --plugin-path "$failing" --duration 1
[ "$("$json_has" "$work/a.json" --print /steps)" = 29 ] || fail "the run did not end after ten failures"

# A collider that lets an exception out of a call ends the program, but not before its outputs are completed.
threw="let an exception out of detect"
ends 4 "collider \"throws\" $threw: the tree has lost its root" "$small" --collider throws --plugin-path "$bad"
[ "$("$json_has" "$work/a.json" --print /steps)" = 19 ] || fail "the steps before the exception are not in the summary"
[ "$("$json_has" "$work/a.json" --print /ended)" = '"the collider failed"' ] || fail "the summary does not tell how it ended"
ends 4 "collider \"throws_on_a_thread\" $threw, on a thread of its own: the tree has lost its root" "$small" \
  --collider throws_on_a_thread --plugin-path "$bad" --threads 2
ends 4 'collider "terminates" called std::terminate in detect' "$small" --collider terminates --plugin-path "$bad"

# One that writes where it must not is not asked again; one that asks for too much is refused, and fails.
ends 4 'collider "overruns" cannot be used any more: in step 20 it wrote more contacts than it had asked room for' "$small" \
  --collider overruns --plugin-path "$bad"
ends 4 'it asked for room for 300000000 contacts, and a sink takes 4194304 at most' "$small" --collider floods --plugin-path "$bad"

# Contacts with a fault are left out, and told of once.
ends 0 'collider "notanumber" gave contacts that were left out: 100 not finite' "$small" --collider notanumber \
  --plugin-path "$bad" --duration 1 --dt 0.01

"$plumb" run "$small" --collider throws_at_once --plugin-path "$bad" 2>"$work/err"
code=$?
cat "$work/err"
[ $code = 4 ] || fail "an exception before the run -> exit $code"
[ "$(cat "$work/err")" = 'plumb: collider "throws_at_once" let an exception out of add: the tree has lost its root' ] ||
  fail "an exception before the run was not told of in one sentence"

# A file that cannot grow any more ends the run, and does not take the others with it.
(trap '' XFSZ; ulimit -f 64; exec "$plumb" run "$small" --quiet --duration 20 --out "$work/b.plumb" --summary "$work/b.json" 2>"$work/err")
code=$?
cat "$work/err"
[ $code = 6 ] || fail "a full file -> exit $code"
[ "$(wc -l <"$work/err")" = 1 ] && grep -q "b.plumb" "$work/err" || fail "a full file was not told of in one line"
[ "$("$json_has" "$work/b.json" --print /ended)" = '"an output failed"' ] || fail "a full file took the summary with it"
"$plumb" export "$work/b.plumb" --out "$work/b.csv" 2>/dev/null || fail "the frames before the file was full do not open"
exit $((failures > 0))
