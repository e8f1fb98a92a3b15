// SPDX-License-Identifier: MIT
/// Triangles from a Wavefront OBJ file (by tinyobjloader).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb::reader {

/// Some triangles and the vertices that they use.
struct TriangleMesh {
    std::string name;  ///< of the object or group
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
};

/// All faces of a file as one mesh. Polygons are cut into triangles; triangles without area are
/// left out. Throws BadShape when the file cannot be read, has no faces, or has numbers that are
/// not finite.
TriangleMesh load_obj(const std::filesystem::path& file);

/// The same, one mesh for each object or group that has faces.
std::vector<TriangleMesh> load_obj_groups(const std::filesystem::path& file);

}  // namespace plumb::reader
