// SPDX-License-Identifier: MIT
/// URDF files, by urdfdom. What looks alone serves (visual elements, materials) is not read, and
/// limits of velocity of 0 are not kept: many files have them where they mean none.
#pragma once

#include "reader/robots/description.h"

#include <filesystem>

namespace plumb::reader {

/// Throws BadRobot for what is not a tree of sound elements, and SceneError where the file cannot
/// be read.
RobotDescription load_urdf(const std::filesystem::path& file);

}  // namespace plumb::reader
