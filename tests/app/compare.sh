#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# compare.sh BUILD SOURCE BAD_PLUGINS: colliders that agree, colliders that do not, one in a process of its own, one whose process
# dies, and mistakes on the command line.
set -u
plumb=$1/bin/plumb json_has=$1/bin/plumb_json_has source=$2 failing=$1/lib/plumb/failing_plugins bad=$3
scenes=$source/samples/scenes small=$source/tests/structure/small_pile.json
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
value() { "$json_has" "$1" --print "$2"; }

# ends CODE WORDS ARGUMENTS…: the comparison ends with the code; the words stand in what it says.
ends() {
  local code=$1 words=$2 got
  shift 2
  "$plumb" compare "$@" --quiet >"$work/out" 2>"$work/err"
  got=$?
  echo "$got: $(tail -n 1 "$work/out")$(cat "$work/err")"
  [ $got = "$code" ] || fail "compare $* -> exit $got, wanted $code"
  grep -qF -- "$words" "$work/out" "$work/err" || fail "compare $* did not say \"$words\""
  [ "$(wc -l <"$work/err")" -le 1 ] || fail "compare $* said more than one line on stderr"
}

# Three colliders on a pile that falls: they agree, all of them, and most normals are the back-ends' own (ODE is silent on
# most shapes that are apart).
ends 0 "The colliders agree." "$small" --colliders ode,bullet,reference --every 5 --json "$work/small.json"
"$json_has" "$work/small.json" /pairs/2/clipped/convex/rows/5/within /colliders/2/clipped/ms/median || fail "JSON lacks figures"
for pair in 0 1 2; do
  [ "$(value "$work/small.json" /pairs/$pair/agrees)" = true ] || fail "pair $pair of colliders differs"
  [ "$(value "$work/small.json" /pairs/$pair/clipped/convex/compared)" -gt 1000 ] || fail "pair $pair of colliders: nothing was compared"
  awk "BEGIN { exit !($(value "$work/small.json" /colliders/$pair/clipped/own_normal_share) >= 0.9) }" || fail "collider $pair: normals are not its own"
done

# The same, but two of them in processes of their own and another driver's poses: not a figure of what was compared changes.
ends 0 "The colliders agree." "$small" --colliders ode,bullet,reference --every 5 --isolate --json "$work/apart.json"
[ "$(value "$work/apart.json" /colliders/1/own_process)" = true ] || fail "bullet ran in the same process"
[ "$(value "$work/apart.json" /pairs)" = "$(value "$work/small.json" /pairs)" ] || fail "a process of its own changes the figures"
[ "$(value "$work/apart.json" /disagreements)" = "$(value "$work/small.json" /disagreements)" ] || fail "a process of its own changes the answers"
ends 0 "driven by bullet" "$small" --colliders ode,bullet --drive bullet --every 50

# Bullet's two precisions must not share a process: the second one gets its own, whichever it is.
for pair in bullet,bullet_float bullet_float,bullet; do
  ends 0 "The colliders agree." "$small" --colliders $pair --every 20 --json "$work/precisions.json"
  [ "$(value "$work/precisions.json" /colliders/0/own_process)" = false ] || fail "$pair: the first one did not drive"
  [ "$(value "$work/precisions.json" /colliders/1/own_process)" = true ] || fail "$pair: both ran in one process"
  [ "$(value "$work/precisions.json" /pairs/0/clipped/convex/compared)" -gt 100 ] || fail "$pair: nothing was compared"
done
"$plumb" run "$scenes/pile.json" --collider bullet_float --duration 2 --quiet >"$work/out" 2>&1 || fail "bullet_float: $(cat "$work/out")"

# Deep boxes: two colliders take the exact axes for others than the third. Both answers are kept whole.
ends 1 "The colliders differ." "$scenes/deep_boxes.json" --colliders ode,reference --duration 0.5 --json "$work/deep.json"
"$plumb" compare "$scenes/deep_boxes.json" --colliders ode,reference --duration 0.1 --quiet >/dev/full 2>"$work/err"
[ $? = 6 ] && grep -q "stdout: cannot be written" "$work/err" || fail "a difference that could not be told: $(cat "$work/err")"
grep -q "THEY DIFFER" "$work/out" || fail "no verdict for the pair of colliders"
"$json_has" "$work/deep.json" /disagreements/0/answers/0/contacts/0/normal /disagreements/0/answers/1/contacts/0/point \
  /disagreements/0/bodies/1/rotation /disagreements/0/words || fail "JSON lacks the answers"

# Meshes deep in each other: the colliders agree, what their back-ends themselves say does not.
ends 0 "The colliders agree." "$scenes/coarse_tori.json" --colliders bullet,ode --duration 0.3
grep -q "torus_.* (mesh of 576 triangles)" "$work/out" || fail "the raw answers on tori do not differ"
ends 1 "The colliders differ." "$scenes/coarse_tori.json" --colliders bullet,ode --duration 0.3 --judge-raw --json "$work/tori.json"
grep -q "THEY DIFFER" "$work/out" || fail "raw answers that differ have no verdict"
[ "$(value "$work/tori.json" /agrees)" = false ] || fail "raw answers that differ agree in the JSON"

# The page carries the comparison, the shapes of its findings, and charts of free runs; nothing of it comes from elsewhere.
# A run through a process of its own is the same run.
ends 1 "Free runs" "$scenes/deep_boxes.json" --colliders ode,reference --duration 0.5 --free-run --out "$work/deep.html" \
  --json "$work/here.json"
for part in plumb-comparison plumb-shapes plumb-meshes '"free_run"' '"half_extents"' "</html>"; do
  grep -qF -- "$part" "$work/deep.html" || fail "the page has no $part"
done
ends 1 "Free runs" "$scenes/deep_boxes.json" --colliders ode,reference --duration 0.5 --free-run --isolate --json "$work/there.json"
[ "$(value "$work/here.json" /free_run)" = "$(value "$work/there.json" /free_run)" ] || fail "a process of its own changes the run"
awk "BEGIN { exit !($(value "$work/here.json" /free_run/pairs/0/largest/20) > 0) }" || fail "runs on different answers do not part"

# JSON on stdout is JSON alone.
"$plumb" compare "$small" --colliders ode,reference --every 50 --quiet --json - >"$work/stdout.json" || fail "--json - failed"
[ "$(value "$work/stdout.json" /agrees)" = true ] || fail "--json - is no comparison"

# A collider that ends its process ends the comparison, in order; so does one that cannot do the scene.
ends 4 'collider "dying" gave no answer' "$small" --colliders ode,dying --isolate --plugin-path "$failing"
ends 4 "cannot detect" "$scenes/shapes.json" --colliders bullet,reference --isolate
# One that fails on parts goes on, and is told of; what it leaves out counts.
ends 1 "made to fail" "$small" --colliders ode,hiccup --every 10 --plugin-path "$failing"

# Colliders that fail alike do not agree, nor do those whose contacts are no numbers.
ends 1 "No verdict: not all colliders gave whole answers." "$small" --colliders failing,hiccup --every 10 --plugin-path "$failing" \
  --json "$work/failed.json"
[ "$(value "$work/failed.json" /agrees)" = false ] || fail "two that failed are said to agree"
[ "$(value "$work/failed.json" /pairs/0/clipped/convex/agrees)" = true ] || fail "the two did not fail alike"
ends 1 "NO VERDICT, notanumber failed" "$small" --colliders hiccup,notanumber --every 100000 --plugin-path "$failing:$bad"

# A run that diverges ends the comparison with its own code, and says so; so do free runs.
ends 5 "diverged: the run that ode drives is no longer finite after step" "$scenes/spinner.json" --colliders ode,reference \
  --set gyroscopic=explicit --dt 0.2 --duration 20 --json "$work/diverged.json"
grep -q "The run diverged in step $(value "$work/diverged.json" /diverged_after_step); nothing after it" "$work/out" ||
  fail "the text does not tell of the divergence"
[ "$(value "$work/diverged.json" /poses)" -gt 1 ] || fail "nothing was compared before the divergence"
ends 5 "; the free run of ode is no longer finite after step" "$scenes/spinner.json" --colliders ode,reference \
  --set gyroscopic=explicit --dt 0.2 --duration 20 --free-run

ends 2 "--colliders is required" "$small"
ends 2 "two are needed" "$small" --colliders ode
ends 2 "twice" "$small" --colliders ode,ode
ends 2 'did you mean "bullet"' "$small" --colliders ode,bullet --drive bulet
ends 2 ".html" "$small" --colliders ode,bullet --out "$work/x.png"
ends 2 "named twice" "$small" --colliders ode,bullet --out "$work/x.html" --json "$work/x.html"
ends 2 "named twice" "$small" --colliders ode,bullet --out "$work/x.html" --json "$work/./x.html"
ends 2 "--every" "$small" --colliders ode,bullet --every 0
ends 3 "absent.json" "$work/absent.json" --colliders ode,bullet
ends 4 '(did you mean "bullet"?); installed are' "$small" --colliders ode,bulet
ends 6 "No such file" "$small" --colliders ode,bullet --json "$work/absent/x.json"
exit $((failures > 0))
