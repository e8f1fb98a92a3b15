// SPDX-License-Identifier: MIT
/// What collides of a robot's links, as shapes; meshes are read from their files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reader/robots/tree.h"

namespace plumb::reader {

struct CollisionOptions {
    std::filesystem::path folder;  ///< of the robot's file, from where meshes are looked for
    bool meshes_required = true;   ///< else those that cannot be had are left out, with a remark
    bool decompose = false;        ///< several hulls for a mesh instead of one
};

/// The shapes of all links of a group, in its frame. A mesh is its convex hull; of a group that
/// does not move, the mesh itself. Throws BadRobot.
std::vector<GeometryPart> collision_parts(const LinkGroup& group, bool moves,
                                          const CollisionOptions& options,
                                          std::vector<std::string>& remarks);

/// The least height (y) of a shape at a place in the world [m]; infinite where it has no points.
double lowest_point(const Geometry& geometry, const Placement& place);

}  // namespace plumb::reader
