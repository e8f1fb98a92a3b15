#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# custom_collider.sh SOURCE BUILD CMAKE: the sample with a collider of its own builds against the installed package, and
# its ball swings in the bowl with the period of the formula (the sample's exit code tells).
set -eu
source=$1 build=$2 cmake=$3
work=$build/custom-collider-test
rm -rf "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null
"$cmake" -S "$source/samples/custom_collider" -B "$work/sample" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
"$cmake" --build "$work/sample" >/dev/null
"$work/sample/custom_collider"
