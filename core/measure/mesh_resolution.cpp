// SPDX-License-Identifier: MIT
#include "measure/mesh_resolution.h"

#include "math/types.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace plumb {
namespace {

constexpr double kSharpest = std::numbers::pi / 3;  // [rad]

/// A triangle beside an edge.
struct Side {
    Vector3d normal;
    double height;  ///< over the edge [m]
};

double sagitta_across(const Side& p, const Side& q) {
    const double angle = std::acos(std::clamp(p.normal.dot(q.normal), -1.0, 1.0));
    return angle > kSharpest ? 0 : 0.25 * (p.height + q.height) * std::tan(angle / 4);
}

MeshResolution resolution_of_triangles(const Shape& s) {
    MeshResolution result;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Side> open;  // edges met once so far
    for (std::uint32_t t = 0; t < s.face_count; ++t) {
        const std::uint32_t* corner = s.faces + 3 * t;
        const Vector3d p[3] = {to_eigen(s.vertices[corner[0]]), to_eigen(s.vertices[corner[1]]),
                               to_eigen(s.vertices[corner[2]])};
        const Vector3d area = (p[1] - p[0]).cross(p[2] - p[0]);
        if (!(area.norm() > 0)) continue;
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t u = corner[i], v = corner[(i + 1) % 3];
            const double length = (p[(i + 1) % 3] - p[i]).norm();
            const Side side{area.normalized(), area.norm() / length};
            result.longest_edge = std::max(result.longest_edge, length);
            const auto [other, is_new] = open.try_emplace(std::minmax(u, v), side);
            if (!is_new)
                result.sagitta = std::max(result.sagitta, 2 * sagitta_across(other->second, side));
        }
    }
    return result;
}

}  // namespace

MeshResolution mesh_resolution(const Shape& s) {
    if (s.kind == ShapeKind::mesh) return resolution_of_triangles(s);
    if (s.kind == ShapeKind::height_field) return {0, std::hypot(s.spacing_x, s.spacing_z)};
    MeshResolution coarsest;
    for (std::uint32_t i = 0; i < s.part_count; ++i) {
        const MeshResolution part = mesh_resolution(s.parts[i].shape);
        coarsest.sagitta = std::max(coarsest.sagitta, part.sagitta);
        coarsest.longest_edge = std::max(coarsest.longest_edge, part.longest_edge);
    }
    return coarsest;
}

}  // namespace plumb
