#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bad_input.sh BUILD SOURCE BAD_PLUGINS: each mistake has its exit code and one clear sentence, and nothing crashes.
set -u
plumb=$1/bin/plumb scenes=$2/samples/scenes bad_plugins=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# expect CODE WORDS COMMAND…: the command ends with the code and says one line that holds the words.
expect() {
  local code=$1 words=$2
  shift 2
  "$@" >"$work/out" 2>"$work/err"
  local got=$?
  local lines
  lines=$(wc -l <"$work/err")
  if [ $got != "$code" ] || [ "$lines" != 1 ] || ! grep -q '^plumb: ' "$work/err" || ! grep -qF -- "$words" "$work/err"; then
    echo "FAILED: $* -> exit $got (wanted $code), said: $(cat "$work/err") (wanted one line with \"$words\")"
    failures=$((failures + 1))
  else
    echo "ok $code: $(cat "$work/err")"
  fi
}

# scene NAME TEXT: a scene's file.
scene() { printf '%s' "$2" >"$work/$1"; }
body='{"name": "a", "shape": {"sphere": {"radius": 1}}'
scene broken.json '{"bodies": ['
scene key.json '{"bodys": []}'
scene nan.json "{\"bodies\": [$body, \"mass\": NaN}]}"
scene mass.json "{\"bodies\": [$body, \"mass\": -1}]}"
scene friction.json '{"materials": {"ice": {"friction": -0.1}}}'
scene shape.json '{"bodies": [{"shape": {"spere": {"radius": 1}}}]}'
scene material.json "{\"materials\": {\"wood\": {}}, \"bodies\": [$body, \"material\": \"wod\"}]}"
scene effect.json '{"settings": {"require": ["shok_propagation"]}}'
scene mesh.json '{"bodies": [{"shape": {"mesh": {"obj": "absent.obj"}}, "motion": "fixed"}]}'
mkdir "$work/folder.obj" "$work/folder.stl"
scene folder.json '{"bodies": [{"shape": {"mesh": {"obj": "folder.obj"}}, "motion": "fixed"}]}'
scene folder.urdf '<robot name="r"><link name="a"><collision><geometry><mesh filename="folder.stl"/></geometry></collision></link></robot>'
scene cone.json '{"bodies": [{"shape": {"cone": {"radius": 1, "half_height": 1}}}, {"shape": {"cone": {"radius": 1, "half_height": 1}}}]}'
scene pair.json '{"bodies": [{"shape": {"plane": {}}, "motion": "fixed"},
  {"shape": {"height_field": {"rows": 2, "columns": 2, "spacing": [1, 1], "heights": [0, 0, 0, 0]}}, "motion": "fixed"},
  {"shape": {"mesh": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "triangles": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}}}]}'
scene cloth.json '{"deformables": [{"kind": "cloth", "shape": {"grid": {"size": [1, 1]}}, "thickness": -1}]}'
scene balloon.json '{"deformables": [{"kind": "balloon", "shape": {"mesh": {"points": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "triangles": [[0,2,1],[0,1,3],[0,3,2]]}}}]}'
scene link.json '{"links": [{"a": {"deformable": "string", "point": 0}, "b": {"position": [0, 1, 0]}}]}'
scene inertia.json "{\"bodies\": [$body, \"mass\": 1, \"inertia\": [1, 1, 5]}]}"

scene torn.urdf '<robot name="r"><link name="a">'
scene massless.urdf '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint></robot>'
scene mesh.urdf '<robot name="r"><link name="a"><collision><geometry><mesh filename="package://p/absent.stl"/></geometry></collision></link></robot>'
scene robot.json '{"robots": [{"urdf": "mesh.urdf"}]}'

expect 3 "torn.urdf: not good XML" "$plumb" check "$work/torn.urdf"
expect 3 'massless.urdf: link "b" has no mass, so it cannot move' "$plumb" run "$work/massless.urdf"
expect 3 'link "a": there is no mesh file "package://p/absent.stl"' "$plumb" run "$work/mesh.urdf"
expect 3 "/robots/0/urdf" "$plumb" run "$work/robot.json"
expect 3 "absent.json" "$plumb" run "$work/absent.json"
expect 3 "line 1" "$plumb" check "$work/broken.json"
expect 3 "did you mean \"bodies\"" "$plumb" check "$work/key.json"
expect 3 "nan.json" "$plumb" check "$work/nan.json"
expect 3 "/bodies/0/mass" "$plumb" check "$work/mass.json"
expect 3 "/deformables/0/thickness" "$plumb" check "$work/cloth.json"
expect 3 "the edge from point 1 to point 2 belongs to triangle 0 alone" "$plumb" check "$work/balloon.json"
expect 3 "/links/0/a/deformable" "$plumb" check "$work/link.json"
expect 3 "/materials/ice/friction" "$plumb" check "$work/friction.json"
expect 3 "did you mean \"sphere\"" "$plumb" check "$work/shape.json"
expect 3 "did you mean \"wood\"" "$plumb" check "$work/material.json"
expect 3 '/settings/require/0: there is no effect "shok_propagation"; did you mean "shock_propagation"?' "$plumb" check "$work/effect.json"
expect 3 "absent.obj" "$plumb" check "$work/mesh.json"
expect 3 'folder.obj" is a folder; name a file in it' "$plumb" check "$work/folder.json"
expect 3 'folder.stl" in ' "$plumb" check "$work/folder.urdf"
expect 3 'is a folder; name a file in it' "$plumb" check "$work/folder.urdf"
expect 3 "/bodies/0/inertia" "$plumb" check "$work/inertia.json"
expect 4 "installed are" "$plumb" check "$scenes/stack.json" --collider physx
expect 4 "no installed collider can detect moving mesh against height_field" "$plumb" run "$work/pair.json"
expect 4 "able are: bullet" "$plumb" check "$work/cone.json" --collider ode
expect 4 "version" "$plumb" check "$scenes/stack.json" --plugin-path "$bad_plugins" --collider oldabi
expect 4 "cannot be loaded" "$plumb" check "$scenes/stack.json" --plugin-path "$bad_plugins" --collider junk
expect 4 "does not export" "$plumb" check "$scenes/stack.json" --plugin-path "$bad_plugins" --collider nosymbol
# refused NAME WORDS: a bad plugin is refused with the words when it is asked for.
refused() { expect 4 "$2" "$plumb" check "$scenes/stack.json" --plugin-path "$bad_plugins" --collider "$1"; }
refused tableless "returned no table"
refused throws_loaded "threw: the entry will not have it"
refused nameless "no name"
refused untold "lacks a description, a version or a precision"
refused imprecise '"half"'
refused helpless "lacks the function that makes or destroys"
refused short "smaller than this version's"
refused resized "structs have other sizes"
refused unmade 'collider "unmade" could not be made: it gave no reason'
refused throws_made 'collider "throws_made" could not be made: it threw: no licence was found'
refused folder "it is not a regular file"
# a copy that was broken off, wherever, is refused and does not stand in the way of others
mkdir "$work/cut"
reference=$1/lib/plumb/plugins/plumb_collider_reference.so
for bytes in 0 40 100 5000 $(($(stat -c %s "$reference") / 2)); do
  head -c "$bytes" "$reference" >"$work/cut/plumb_collider_cut.so"
  expect 4 "cannot be loaded" "$plumb" check "$scenes/stack.json" --plugin-path "$work/cut" --collider cut
  "$plumb" check "$scenes/stack.json" --plugin-path "$work/cut" --collider ode >"$work/out" 2>&1 || failures=$((failures + 1))
done
expect 2 "is not a directory; name the one" "$plumb" check "$scenes/stack.json" --plugin-path "$reference"
expect 2 "there is no such directory" "$plumb" check "$scenes/stack.json" --plugin-path "$work:$work/absent"
expect 2 "there is no such directory" "$plumb" colliders --plugin-path "$work/absent"
expect 4 'there is no collider ""' "$plumb" colliders --check ""
# files that are no plugins are refused by the suite with the loader's sentence, and not called dead
for file in junk nosymbol oldabi folder; do
  expect 4 "plumb_collider_$file.so was refused: it" "$plumb" colliders --check "$bad_plugins/plumb_collider_$file.so"
done
head -c 5000 "$1/lib/plumb/plugins/plumb_collider_reference.so" >"$work/plumb_collider_torn.so"
expect 4 "was refused: it cannot be loaded: it is cut short" "$plumb" colliders --check "$work/plumb_collider_torn.so"
expect 4 "there is no file" "$plumb" colliders --check "$work/absent.so"
# a misspelt collider, wherever one is named
expect 4 'there is no collider "oed" (did you mean "ode"?); installed are' "$plumb" run "$scenes/stack.json" --collider oed
expect 2 'unknown value "clipped"' "$plumb" run "$scenes/stack.json" --set contacts=clipped
expect 2 "leave one of them out" "$plumb" effects "$scenes/stack.json" --ablate --no-run
expect 6 "No such file or directory" "$plumb" effects "$scenes/stack.json" --ablate --json "$work/absent/x.json"
expect 4 '(did you mean "bullet_float"?)' "$plumb" effects "$scenes/stack.json" --collider bulletfloat
expect 4 '(did you mean "reference"?)' "$plumb" colliders --check refrence
# of two plugins of one name the first is taken; the other is refused with who was first
good_plugins=$1/lib/plumb/plugins
expect 4 "$good_plugins/plumb_collider_reference.so has already taken" \
  "$plumb" check "$scenes/stack.json" --plugin-path "$good_plugins:$bad_plugins" --collider taken
expect 6 "No such file or directory" "$plumb" run "$scenes/stack.json" --collider ode --out "$work/absent/x.html"
expect 6 "No such file or directory" "$plumb" run "$scenes/stack.json" --collider ode --summary "$work/absent/x.json"
expect 2 "did you mean .html?" "$plumb" run "$scenes/stack.json" --collider ode --out "$work/x.hmtl"
expect 6 "absent" "$plumb" run "$scenes/stack.json" --out "$work/absent/x.plumb"
expect 6 "Is a directory" "$plumb" run "$scenes/stack.json" --summary "$work"
expect 3 "not a file" "$plumb" run "$work"
expect 2 "scene is required" "$plumb" run
expect 2 "a verb is missing" "$plumb"
expect 2 "did you mean \"check\"" "$plumb" chek
expect 2 "unknown verb \"rnu\"; did you mean \"run\"" "$plumb" rnu "$scenes/stack.json" --quiet
expect 2 "Allowed: run, colliders" "$plumb" walk
expect 2 "did you mean \"--collider\"" "$plumb" run "$scenes/stack.json" --colider ode
expect 2 "did you mean \"--substeps\"" "$plumb" run "$scenes/stack.json" --substep=3
expect 2 "named twice" "$plumb" run "$scenes/stack.json" --out "$work/x.csv" --out "$work/./x.csv"
# an output must not be what is read, nor another output, by whatever name
cp "$scenes/stack.json" "$work/own.json"
ln "$work/own.json" "$work/hard.json"
ln -s own.json "$work/soft.json"
for own in own hard soft; do
  expect 2 "is what is read" "$plumb" run "$work/own.json" --collider ode --duration 0.1 --summary "$work/$own.json"
done
"$plumb" run "$scenes/stack.json" --collider ode --duration 0.1 --quiet --out "$work/own.plumb"
ln -s own.plumb "$work/soft.csv"
expect 2 "is what is read" "$plumb" export "$work/own.plumb" --out "$work/soft.csv"
expect 3 "cannot be opened" "$plumb" export "$work/nowhere.plumb" --out "$work/a.csv"
expect 3 "is not a recording" "$plumb" export "$work/own.json" --out "$work/a.csv"
ln -s absent.csv "$work/dangling.csv"
expect 2 "named twice" "$plumb" run "$scenes/stack.json" --out "$work/absent.csv" --out "$work/dangling.csv"
"$plumb" run "$scenes/stack.json" --collider ode --duration 0.1 --quiet --out "$work/dangling.csv"
if [ ! -L "$work/dangling.csv" ] || [ ! -s "$work/absent.csv" ]; then
  echo "FAILED: an output that is a link is not written where that leads"
  failures=$((failures + 1))
fi
expect 6 "cannot be written" bash -c 'ulimit -f 1; "$@"' limited "$plumb" run "$scenes/pyramid.json" --collider ode --duration 0.5 --quiet --out "$work/x.csv"
expect 0 "nothing is run" "$plumb" run "$scenes/stack.json" --collider ode --duration 0.001
expect 0 "both required and forbidden" "$plumb" check "$scenes/stack.json" --set 'require=["friction"]' --set 'forbid=["friction"]'
expect 2 "must be a number above 0" "$plumb" run "$scenes/stack.json" --fps 0
expect 2 "--substeps many: must be" "$plumb" run "$scenes/stack.json" --substeps many
expect 2 "--substeps 0: must be" "$plumb" run "$scenes/stack.json" --substeps 0
expect 2 "--duration -1: must be" "$plumb" run "$scenes/stack.json" --duration -1
expect 2 "--lanes 3: must be" "$plumb" run "$scenes/stack.json" --lanes 3 --collider ode
expect 2 "Allowed: pbd" "$plumb" run "$scenes/stack.json" --method verlet
expect 2 "Allowed: single, double" "$plumb" run "$scenes/stack.json" --precision half
expect 2 "unknown key \"fricton\"" "$plumb" run "$scenes/stack.json" --set fricton=1
expect 2 "write key=value" "$plumb" run "$scenes/stack.json" --set dt

expect 6 "stdout" bash -c "'$plumb' colliders >/dev/full"
expect 6 "stdout" bash -c "'$plumb' run '$scenes/stack.json' --collider ode --duration 0.1 --summary - >/dev/full"

# bad plugins are listed with their reason and do not stand in the way of good ones
"$plumb" colliders --short --plugin-path "$bad_plugins" >"$work/list" || failures=$((failures + 1))
for words in "refused: its table has no name" "refused: its table is smaller" "refused: plumb_collider_plugin threw" "reference" "ode" "bullet" "bullet_float" "fcl"; do
  grep -q "$words" "$work/list" || { echo "FAILED: plumb colliders does not say $words"; failures=$((failures + 1)); }
done
exit $((failures > 0))
