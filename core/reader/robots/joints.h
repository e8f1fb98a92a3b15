// SPDX-License-Identifier: MIT
/// A robot's joints as joints of a scene.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reader/robots/robot.h"
#include "reader/robots/tree.h"

namespace plumb::reader {

/// The joint of a group that is placed; bodies and name are still to be set. Coordinates are
/// counted from `start`, where it begins [rad], [m].
JointSpec joint_of(const LinkGroup& group, double start, const RobotOptions& options,
                   std::vector<std::string>& remarks);

/// What ties a joint to the one that it mimics; the joints are still to be set.
CouplingSpec coupling_of(const RobotJoint& joint, const RobotJoint& mimicked,
                         const std::map<std::string, double>& starts);

/// Throws BadRobot for motors of joints that are not there or cannot have one.
void check_motors(const RobotDescription& robot, const RobotOptions& options);

}  // namespace plumb::reader
