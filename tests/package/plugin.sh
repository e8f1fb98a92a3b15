#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# plugin.sh SOURCE BUILD CMAKE: a plugin made outside of the tree with the package's plumb_add_plugin holds a ball, and a
# scene that it lacks a pair for is refused with that pair named (exit code 4).
set -eu
source=$1 build=$2 cmake=$3
work=$build/plugin-test
rm -rf "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null
"$cmake" -S "$source/tests/package/outside" -B "$work/outside" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
"$cmake" --build "$work/outside" >/dev/null

export PLUMB_PLUGIN_PATH=$work/outside/lib/plumb/plugins
plumb=$work/prefix/bin/plumb
listed=$("$plumb" colliders --short)
echo "$listed"
echo "$listed" | grep "^level " >/dev/null
"$plumb" run "$source/tests/package/outside/ball.json" --collider level --quiet --out "$work/ball.csv"
tail -n 1 "$work/ball.csv"
tail -n 1 "$work/ball.csv" | awk -F, '{ exit !($4 == "ball" && $6 > 0.2499 && $6 < 0.2501) }'

code=0
said=$("$plumb" check "$source/samples/scenes/bounce.json" --collider level 2>&1) || code=$?
echo "$said"
[ "$code" = 4 ]
case "$said" in *"sphere against sphere"*) ;; *) exit 1 ;; esac
