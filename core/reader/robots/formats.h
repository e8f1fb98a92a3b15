// SPDX-License-Identifier: MIT
/// The formats of robots' files, by the ending of their names.
#pragma once

#include "reader/robots/description.h"

#include <filesystem>

namespace plumb::reader {

/// Whether files with such a name are known to be robots.
bool is_robot(const std::filesystem::path& file);

/// Reads a file; one with an unknown ending is read as URDF. Throws SceneError, with the file and
/// the names of the links and joints concerned, for what is not a tree of sound elements.
RobotDescription load_robot(const std::filesystem::path& file);

}  // namespace plumb::reader
