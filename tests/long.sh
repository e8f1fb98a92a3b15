#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bash tests/long.sh: heaps of 300 bodies over ten simulated minutes, on every collider that may share a process. It takes
# about an hour, and stands beside what continuous integration runs.
set -eu
cd "$(dirname "$0")/.."
. cmake/setup.sh

install_missing $build_packages $test_packages
build ci
PLUMB_HEAPS=cubes,capsules,hulls,tori PLUMB_HEAP_SECONDS=600 PLUMB_TEST_COLLIDERS=reference,ode,bullet,fcl exec build/ci/bin/plumb_long_heap_tests
