#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# accuracy.sh SOURCE BUILD CMAKE: the sample that sweeps a scene of its own builds against the installed package, and
# says what an error costs.
set -eu
source=$1 build=$2 cmake=$3
work=$build/accuracy-test
rm -rf "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null
unset PLUMB_PLUGIN_PATH
"$cmake" -S "$source/samples/accuracy" -B "$work/sample" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
"$cmake" --build "$work/sample" >/dev/null
"$work/sample/accuracy" | tee "$work/said"
grep -qE ' costs [0-9.e+]+ µs of CPU a simulated second: ' "$work/said"
