// SPDX-License-Identifier: MIT
/// What acts along or about an axis that a joint leaves free: limits, motor, spring, friction.
#pragma once

#include "reader/json/table.h"
#include "scene/joint.h"

namespace plumb::reader {

/// What joints' forces, torques and stiffnesses may be.
inline constexpr Range kStrength{0, 1e15};

/// "limits", "motor", "spring" and "friction".
const Table<JointAxisSpec>& joint_axis_table();

/// The $defs that this table refers to, and its own.
void add_joint_axis_definitions(SchemaJson& definitions);

}  // namespace plumb::reader
