#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# layers_catches.sh CHECK BUILD: the check of the layers lets good includes pass and names each kind of bad one.
set -eu
check=$1 tree=$2/layer-test

# try FILE INCLUDE…: the check's verdict on a tree that holds one file.
try() {
  rm -rf "$tree" && mkdir -p "$tree/core" "$tree/interfaces" "$tree/plugins" "$(dirname "$tree/$1")"
  printf '#include %s\n' "${@:2}" >"$tree/$1"
  bash "$check" "$tree"
}
passes() { try "$@" || { echo "the check forbids $1 to include ${*:2}"; exit 1; }; }
fails() {
  if said=$(try "$@"); then echo "the check lets $1 include ${*:2}"; exit 1; fi
  case "$said" in *"$tree/$1:1: "*) ;; *) echo "the check does not name $1: $said"; exit 1 ;; esac
}

passes core/step/good.h '"step/step.h"' '"math/types.h"' '<plumb/shape.h>' '<Eigen/Core>' '<vector>'
fails core/math/bad.h '"step/step.h"'
fails core/math/bad.h '  "step/step.h"  // for a reason'
fails core/measure/bad.cpp '<host/simulation.h>'
fails core/step/bad.h '"../output/png.h"'
fails core/step/bad.h '"elsewhere/png.h"'
passes core/geometry/good.h '"scene/geometry.h"' '"math/types.h"'
fails core/geometry/bad.h '"world/world.h"'
fails core/scene/bad.h '"geometry/hull.h"'
passes core/contacts/good.h '"effects/plan.h"' '"world/contacts.h"'
fails core/contacts/bad.h '"step/stages.h"'
fails core/contacts/bad.h '"solve/constraint_group.h"'
fails core/elsewhere/bad.h '<vector>'

passes interfaces/plumb/good.h '<plumb/shape.h>' '<cstdint>'
fails interfaces/plumb/bad.h '<Eigen/Core>'
fails interfaces/plumb/bad.h '"shape.h"'

passes plugins/mine/good.cpp '"mine/narrow.h"' '<plumb/plugin.h>' '<ode/ode.h>'
fails plugins/mine/bad.cpp '"world/world.h"'
fails plugins/mine/bad.cpp '"../../core/world/world.h"'
