#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# plugin.sh SOURCE BUILD CMAKE: the sample plugin, built outside of the tree against the installed package, keeps every
# rule of the conformance suite, brings its scene to rest, sees the contacts that the reference sees, and is refused, with
# the pair named (exit code 4), where a scene needs what it lacks.
set -eu
source=$1 build=$2 cmake=$3 sample=$1/samples/custom_plugin
work=$build/plugin-test
rm -rf "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null
"$cmake" -S "$sample" -B "$work/sample" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
"$cmake" --build "$work/sample" >/dev/null

export PLUMB_PLUGIN_PATH=$work/sample/lib/plumb/plugins
plumb=$work/prefix/bin/plumb
"$plumb" colliders --short | grep "^marbles "
"$plumb" colliders --check marbles

"$plumb" run "$sample/marbles.json" --collider marbles --quiet --summary "$work/marbles.json"
value() { "$build/bin/plumb_json_has" "$work/marbles.json" --print "$1"; }
[ "$(value /collider/name)" = '"marbles"' ]
[ "$(value /fallen_through)" = 0 ]
[ "$(value /clamps/rejected_contacts)" = 0 ]
awk -v v="$(value /speed/median)" 'BEGIN { print "median speed " v " m/s"; exit !(v < 0.01) }'
"$plumb" compare "$sample/marbles.json" --colliders marbles,reference --every 10

code=0
said=$("$plumb" check "$source/samples/scenes/stack.json" --collider marbles 2>&1) || code=$?
echo "$said"
[ "$code" = 4 ]
case "$said" in *"cannot detect plane against box"*) ;; *) exit 1 ;; esac
