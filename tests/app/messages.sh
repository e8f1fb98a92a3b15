#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# messages.sh BUILD SOURCE BAD_PLUGINS: --log-level decides what is said on stderr; results stay on stdout alone.
set -u
plumb=$1/bin/plumb json_has=$1/bin/plumb_json_has small=$2/tests/structure/small_pile.json bad=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

# says LEVEL ARGUMENT…: runs the small pile without friction, for 0.05 s.
says() {
  "$plumb" run "$small" --duration 0.05 --set 'forbid=["friction"]' --summary - --log-level "$@" >"$work/out" 2>"$work/err" ||
    fail "run --log-level $* ends with $?"
  "$json_has" "$work/out" /state_hash || fail "--log-level $1: stdout is no summary"
}
warned='plumb: warning: "friction" is forbidden, but the scene calls for it'

says info
[ "$(grep -cF "$warned" "$work/err")" = 1 ] || fail "info does not warn once"
grep -q "^plumb: collider [a-z]*: " "$work/err" || fail "info does not say which collider was chosen"
says warn
grep -qF "$warned" "$work/err" || fail "warn does not warn"
grep -q "^plumb: collider" "$work/err" && fail "warn tells more than warnings"
says error
[ -s "$work/err" ] && fail "error tells of a run that went well"
says off
[ -s "$work/err" ] && fail "off is not silent"
says debug --plugin-path "$bad"
grep -q "^plumb: debug: plugin .*/plumb_collider_junk.so is refused: " "$work/err" || fail "debug does not say why a plugin is refused"
grep -q '^plumb: debug: plugin .* is collider "ode"' "$work/err" || fail "debug does not list the plugins"
[ "$(grep -c "collider [a-z]*: supports" "$work/err")" = 1 ] || fail "debug does not say once which collider was chosen"
says trace --plugin-path "$bad"
grep -q "^plumb: debug: plugin " "$work/err" || fail "trace tells less than debug"

# A wedge, of whose bounds the middle lies on a face: no back-end writes on stdout.
cat >"$work/wedge.json" <<'END'
{"bodies": [
  {"motion": "fixed", "shape": {"plane": {}}},
  {"shape": {"hull": {"vertices": [[-0.3, 0, -0.3], [-0.3, 0, 0.3], [0.3, 0, -0.3], [0.3, 0, 0.3], [0.3, 0.31, -0.3], [0.3, 0.31, 0.3]]}}},
  {"position": [0, 1, 0],
   "shape": {"hull": {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}}}
]}
END
for collider in ode bullet fcl; do
  "$plumb" run "$work/wedge.json" --collider $collider --duration 0.1 --summary - >"$work/out" 2>"$work/err" || fail "a wedge on $collider"
  "$json_has" "$work/out" /state_hash || fail "a wedge on $collider: stdout is no summary: $(head -1 "$work/out")"
done

# A thin rod that no substep may be divided for tears itself loose: the summary says so, too.
cat >"$work/rod.json" <<'END'
{"settings": {"tree_parts": 1, "dt": 0.01, "duration": 4}, "bodies": [
  {"name": "rod", "shape": {"box": {"half_extents": [0.004, 0.4, 0.004]}}, "position": [0.2, -0.35, 0.1],
   "rotation": {"axis": [0, 0, 1], "degrees": 30}}],
 "joints": [{"type": "ball", "bodies": ["rod"], "anchor": [0, 0, 0.104]}]}
END
"$plumb" run "$work/rod.json" --collider reference --quiet --summary - >"$work/out" 2>"$work/err" || fail "a rod ends with $?"
grep -q "^plumb: warning: trees of joints were left open" "$work/err" || fail "nothing is said of a tree that is open"
"$json_has" "$work/out" /warnings/0 || fail "the summary does not warn of a tree that is open"

# Joints that iterations cannot hold are named, with how far, when, and how many bodies they tie: a rope that what a script
# moves pulls further than it goes, and one wheel of two that is turned while the other is held.
cat >"$work/pulled.json" <<'END'
{"settings": {"joints": "iterate", "gravity": [0, 0, 0], "dt": 0.01, "duration": 1}, "bodies": [
  {"name": "held", "shape": {"sphere": {"radius": 0.1}}},
  {"name": "wheel", "shape": {"sphere": {"radius": 0.1}}, "position": [0, 1, 0]},
  {"name": "puller", "motion": "kinematic", "shape": {"sphere": {"radius": 0.1}}, "position": [1, 0, 0], "velocity": [0.5, 0, 0]},
  {"name": "turner", "motion": "kinematic", "shape": {"sphere": {"radius": 0.1}}, "position": [1, 1, 0], "angular_velocity": [0, 0, 1]}],
 "joints": [
  {"name": "weld", "type": "fixed", "bodies": ["held"], "anchor": [0, 0, 0]},
  {"name": "axle", "type": "hinge", "bodies": ["held"], "anchor": [0, 0, 0], "axis": [0, 0, 1]},
  {"name": "shaft", "type": "hinge", "bodies": ["wheel"], "anchor": [0, 1, 0], "axis": [0, 0, 1]},
  {"name": "clutch", "type": "orientation", "bodies": ["wheel", "turner"]},
  {"name": "rope", "type": "distance", "bodies": ["held", "puller"], "anchor": [0, 0, 0], "anchor_b": [1, 0, 0], "limits": [0, 1.1]}],
 "couplings": [{"name": "gear", "joints": ["axle", "shaft"], "ratio": 1}]}
END
"$plumb" run "$work/pulled.json" --collider reference --quiet --summary - >"$work/out" 2>"$work/err" || fail "a pulled rope ends with $?"
grep -q '^plumb: warning: joints were open, or past a limit, in .* of 100 steps: joint "rope" first, at 0.2[0-9]* s, ' "$work/err" ||
  fail "nothing is said of a rope that is too long: $(cat "$work/err")"
grep -q '^plumb: warning: couplings had slipped in .* of 100 steps: coupling "gear" first, at .* rad at ' "$work/err" ||
  fail "nothing is said of a gear that slips"
[ "$("$json_has" "$work/out" --print /open_joints/apart/first/name)" = '"rope"' ] || fail "the summary does not name the rope"
[ "$("$json_has" "$work/out" --print /open_joints/couplings/worst/name)" = '"gear"' ] || fail "the summary does not name the gear"
[ "$("$json_has" "$work/out" --print /open_joints/trees)" = null ] || fail "the summary tells of trees where there is none"
"$json_has" "$work/out" /open_joints/apart/steps /open_joints/apart/worst/error /open_joints/apart/worst/time \
  /open_joints/apart/worst/bodies /open_joints/apart/at_end/unit || fail "the summary does not tell how far a rope is too long"

# A joint that is to give way does, without a word.
cat >"$work/soft.json" <<'END'
{"settings": {"dt": 0.01, "duration": 1}, "bodies": [{"name": "a", "shape": {"sphere": {"radius": 0.1}}, "mass": 10}],
 "joints": [{"type": "ball", "bodies": ["a"], "anchor": [0, 0.1, 0], "compliance": 1e-3}]}
END
"$plumb" run "$work/soft.json" --collider reference --quiet --summary - >"$work/out" 2>"$work/err" || fail "a soft joint ends with $?"
[ -s "$work/err" ] && fail "a joint is called open that gives way: $(cat "$work/err")"

# A rod that is too long at the start is named by its link, also behind one that may give way.
cat >"$work/rod.json" <<'END'
{"settings": {"dt": 0.01, "duration": 0.1}, "bodies": [
   {"name": "a", "shape": {"sphere": {"radius": 0.1}}, "mass": 1},
   {"name": "b", "shape": {"sphere": {"radius": 0.1}}, "mass": 1, "position": [1, 0, 0]}],
 "links": [{"a": {"body": "a"}, "b": {"position": [0, 3, 0]}, "limits": [null, 4]},
           {"a": {"body": "a"}, "b": {"body": "b"}, "length": 1.5}]}
END
"$plumb" run "$work/rod.json" --collider reference --quiet --summary - >"$work/out" 2>"$work/err" || fail "a rod ends with $?: $(cat "$work/err")"
grep -q '^plumb: warning: joints were open, or past a limit, in .*: link 1 first' "$work/err" || fail "the rod is not named: $(cat "$work/err")"
[ "$("$json_has" "$work/out" --print /open_joints/apart/first/link)" = 1 ] || fail "the summary does not name the rod"

# The same without the option; all verbs have it.
"$plumb" run "$small" --duration 0.05 --set 'forbid=["friction"]' >"$work/out" 2>"$work/err" || fail "run ends with $?"
grep -qF "$warned" "$work/err" || fail "a run does not warn unless told"
for verb in run colliders effects check compare cost tune export; do
  "$plumb" $verb --help | grep -q -- "--log-level LEVEL" || fail "$verb has no --log-level"
done
"$plumb" check "$small" --set 'forbid=["friction"]' --log-level error >"$work/out" 2>"$work/err" || fail "check ends with $?"
[ -s "$work/err" ] && fail "check does not know the level"
"$plumb" effects "$small" --no-run --set 'forbid=["friction"]' >"$work/out" 2>"$work/err" || fail "effects ends with $?"
[ "$(grep -cF "$warned" "$work/err")" = 1 ] || fail "effects does not warn once"

# What ends a program is an error: told at each level but off, where the exit code is all.
"$plumb" run "$work/absent.json" --log-level error >"$work/out" 2>"$work/err"
[ $? = 3 ] || fail "an absent scene is no bad scene"
grep -q "^plumb: .*there is no such file" "$work/err" || fail "error does not tell of an error"
"$plumb" run "$work/absent.json" --log-level off >"$work/out" 2>"$work/err"
[ $? = 3 ] || fail "off changes the exit code"
[ -s "$work/err" ] && fail "off tells of an error"
"$plumb" run "$small" --log-level loud >"$work/out" 2>"$work/err"
[ $? = 2 ] || fail "there is a level called loud"
grep -q "^plumb: --log-level: .*loud" "$work/err" || fail "a bad level has no sentence"
"$plumb" run "$small" --log-level inf >"$work/out" 2>"$work/err"
grep -q 'did you mean "info"' "$work/err" || fail "no nearest spelling: $(cat "$work/err")"
exit $((failures > 0))
