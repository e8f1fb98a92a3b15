// SPDX-License-Identifier: MIT
/// A URDF file as urdfdom's model: a tree of links and joints, all of them reached from its root.
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace plumb::reader {

/// A robot description that cannot be used; `what()` is one sentence without the file's name.
class BadRobot : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Reads a file. What looks alone serves (visual elements, materials) is left out. Throws
/// BadRobot, with the names of the links and joints concerned, for what is not a tree of sound
/// elements, and SceneError where the file cannot be read.
urdf::ModelInterfaceSharedPtr load_urdf(const std::filesystem::path& file);

inline std::string link_named(const std::string& name) { return "link \"" + name + "\""; }
inline std::string joint_named(const std::string& name) { return "joint \"" + name + "\""; }

}  // namespace plumb::reader
