#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# emulated.sh BUILD SCENE: on a processor without AVX a scene runs to the same bits, in both precisions, and tests pass.
set -eu
plumb=$1/bin/plumb
emulate="qemu-x86_64 -cpu Nehalem"
hash_of() { "$@" --collider reference --quiet --summary - | sed -n 's/.*"state_hash": "\(.*\)".*/\1/p'; }
for precision in single double; do
  native=$(hash_of "$plumb" run "$2" --precision $precision)
  emulated=$(hash_of $emulate "$plumb" run "$2" --precision $precision)
  echo "$precision: native $native, without AVX $emulated"
  [ -n "$native" ] && [ "$native" = "$emulated" ]
done
$emulate "$1/bin/plumb_paper_tests" --gtest_filter='ContactFormulas*:Connector*:Rotation*:Effects.F*:Effects.C*:Effects.TheP*' --gtest_brief=1
$emulate "$1/bin/plumb_law_tests" --gtest_filter='*Friction.*reference_*:*Bounce.*reference_*:Rotation.C*' --gtest_brief=1
