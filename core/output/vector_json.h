// SPDX-License-Identifier: MIT
/// Vectors and rotations as lists of numbers.
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace plumb {

inline nlohmann::json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline nlohmann::json to_json(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

}  // namespace plumb
