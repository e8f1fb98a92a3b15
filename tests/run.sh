#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bash tests/run.sh: installs what is missing, builds Plumb with warnings as errors, and runs all its tests.
set -eu
cd "$(dirname "$0")/.."
. cmake/setup.sh

install_missing $build_packages $test_packages
build ci
exec ctest --preset ci
