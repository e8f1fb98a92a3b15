// SPDX-License-Identifier: MIT
/// Shapes as the user wrote them: values that own their memory.
#pragma once

#include <plumb/shape.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

inline constexpr std::uint32_t kNoIndex = std::numeric_limits<std::uint32_t>::max();

/// Rotation and translation, local frame → outer frame.
struct Placement {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// The inner frame of `inner` → the outer frame of `outer`.
inline Placement operator*(const Placement& outer, const Placement& inner) {
    return {outer.position + outer.rotation * inner.position,
            (outer.rotation * inner.rotation).normalized()};
}

inline Placement inverse(const Placement& p) {
    const Eigen::Quaterniond back = p.rotation.conjugate();
    return {-(back * p.position), back};
}

struct GeometryPart;

/// One shape; the members mean what they mean in plumb::Shape. Shared by all bodies that name it.
struct Geometry {
    std::string name;
    ShapeKind kind = ShapeKind::sphere;
    Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();  ///< [m]
    double radius = 0;                                       ///< [m]
    double half_height = 0;                                  ///< [m]

    std::vector<Eigen::Vector3d> vertices;  ///< hull, mesh [m]
    std::vector<std::vector<std::uint32_t>>
        faces;  ///< hull: convex polygons, counter-clockwise from outside
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< mesh

    std::vector<double> heights;  ///< height field, [rows × columns] [m]
    std::uint32_t rows = 0, columns = 0;
    double spacing_x = 0, spacing_z = 0;  ///< [m]

    std::vector<GeometryPart> parts;  ///< compound
    std::optional<double> concavity;  ///< compound made from a mesh: how deep the mesh's surface
                                      ///< lies within the parts [m]
};

struct GeometryPart {
    Geometry geometry;
    Placement local;
};

}  // namespace plumb
