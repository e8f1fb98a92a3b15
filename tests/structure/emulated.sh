#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# emulated.sh BUILD SCENE: a processor without AVX runs the scene to the same bits, in both precisions.
set -eu
plumb=$1/bin/plumb
hash_of() { "$@" --collider reference --quiet --summary - | sed -n 's/.*"state_hash": "\(.*\)".*/\1/p'; }
for precision in single double; do
  native=$(hash_of "$plumb" run "$2" --precision $precision)
  emulated=$(hash_of qemu-x86_64 -cpu Nehalem "$plumb" run "$2" --precision $precision)
  echo "$precision: native $native, without AVX $emulated"
  [ -n "$native" ] && [ "$native" = "$emulated" ]
done
