#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# crane.sh SOURCE BUILD CMAKE: the sample that edits a running world builds against the installed package, and on every
# collider its chain bears and its load flies as the formulas say (the sample's exit code tells).
set -eu
source=$1 build=$2 cmake=$3
work=$build/crane-test
rm -rf "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null
unset PLUMB_PLUGIN_PATH
"$cmake" -S "$source/samples/crane" -B "$work/sample" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
"$cmake" --build "$work/sample" >/dev/null
for collider in reference ode bullet fcl; do "$work/sample/crane" "$collider"; done
