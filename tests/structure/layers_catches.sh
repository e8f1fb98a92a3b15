#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# layers_catches.sh CHECK BUILD: the check of the layers fails where a folder looks ahead.
set -eu
tree=$2/layer-test
rm -rf "$tree" && mkdir -p "$tree/core/math" "$tree/interfaces" "$tree/plugins"
echo '#include "step/step.h"' >"$tree/core/math/bad.h"
if bash "$1" "$tree"; then echo "the check let math/ include step/"; exit 1; fi
echo '#include "math/types.h"' >"$tree/core/math/bad.h"
bash "$1" "$tree"
