#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bash tests/long.sh: the tests of the label `long`, heaps of 300 bodies over ten simulated minutes, and structures over one
# at settings drawn at random, on every collider that may share a process. It takes about two hours, and stands beside what
# continuous integration runs.
set -eu
cd "$(dirname "$0")/.."
. cmake/setup.sh

install_missing $build_packages $test_packages
build ci
heaps() {
  PLUMB_HEAPS=$1 PLUMB_TEST_COLLIDERS=$2 PLUMB_HEAP_SECONDS=600 build/ci/bin/plumb_long_heap_tests \
    --gtest_filter='LongHeaps.*:*/LongHeaps.*'
}
failed=0
ctest --test-dir build/ci -L long -j 2 --output-on-failure || failed=1
heaps cubes,capsules reference,ode,bullet,fcl || failed=1
heaps hulls,tori ode,bullet,fcl || failed=1  # reference does not do them
PLUMB_STRUCTURE_SECONDS=60 PLUMB_STRUCTURE_DRAWS=8 build/ci/bin/plumb_hard_tests \
  --gtest_filter='*Structures.LargeOnes*:*Structures.RestAtDrawn*' || failed=1
exit $failed
