#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# contacts.sh SOURCE BUILD CMAKE: the sample that reads contacts builds against the installed package, and on every
# collider its scale is right (the sample's exit code tells); another process that goes on from the state which the first
# has written ends with the same words.
set -eu
source=$1 build=$2 cmake=$3
work=$build/contacts-test
rm -rf "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >/dev/null
unset PLUMB_PLUGIN_PATH
"$cmake" -S "$source/samples/contacts" -B "$work/sample" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
"$cmake" --build "$work/sample" >/dev/null
cd "$work"
for collider in reference ode bullet fcl; do
  sample/contacts "$collider" | tee first.txt
  sample/contacts "$collider" contacts.state >second.txt
  grep -q "meet at" first.txt
  [ "$(tail -n 1 first.txt)" = "$(tail -n 1 second.txt)" ]
done
