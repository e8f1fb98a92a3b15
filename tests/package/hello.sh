#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# hello.sh SOURCE BUILD CMAKE: installs the build into a prefix, moves the prefix, and builds and runs samples/hello there
# with the colliders of that prefix, once with plain flags and once for this very processor: flags must not change how a
# scene is laid out in memory.
set -eu
source=$1 build=$2 cmake=$3
work=$build/package-test
rm -rf "$work"
"$cmake" --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix"
unset PLUMB_PLUGIN_PATH
for flags in "" -march=native; do
  "$cmake" -S "$source/samples/hello" -B "$work/hello$flags" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
  "$cmake" --build "$work/hello$flags" >/dev/null
  for collider in reference ode bullet fcl bullet_float; do
    said=$("$work/hello$flags/hello" "$collider")
    echo "$said"
    [ "$said" = "$collider: after 3 s the box rests at 0.2500 m and the ball at 0.3000 m" ]
  done
done
"$work/prefix/bin/plumb" check "$work/prefix/share/plumb/scenes/stack.json"  # finds the plugins beside itself
