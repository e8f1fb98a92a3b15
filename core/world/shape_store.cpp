// SPDX-License-Identifier: MIT
#include "world/shape_store.h"

#include "math/types.h"
#include "scene/error.h"

#include <algorithm>
#include <string>

namespace plumb {
namespace {

/// Newell's normal of a polygon: right for any planar corner order, and the mean where it is
/// slightly bent.
Vector3d polygon_normal(const Geometry& g, const std::uint32_t* corners, std::size_t count) {
    Vector3d sum = Vector3d::Zero();
    const Vector3d& from = g.vertices[corners[0]];
    for (std::size_t i = 0; i < count; ++i)
        sum += (g.vertices[corners[i]] - from).cross(g.vertices[corners[(i + 1) % count]] - from);
    return sum.norm() > 0 ? Vector3d(sum.normalized()) : Vector3d(Vector3d::UnitY());
}

bool has_corners(const Geometry& g, const std::uint32_t* corners, std::size_t count) {
    return count >= 3 && std::all_of(corners, corners + count,
                                     [&](std::uint32_t c) { return c < g.vertices.size(); });
}

/// Throws where indices lead out of the arrays that they are of.
void check_arrays(const Geometry& g) {
    bool whole = true;
    for (const auto& face : g.faces) whole = whole && has_corners(g, face.data(), face.size());
    for (const auto& t : g.triangles) whole = whole && has_corners(g, t.data(), 3);
    const std::string shape = "the " + std::string(name_of(g.kind)) + " \"" + g.name + "\" has ";
    if (!whole) throw SceneError("", "/shapes", shape + "a face of corners that there are not");
    if (g.heights.size() != std::size_t(g.rows) * g.columns)
        throw SceneError("", "/shapes", shape + "not as many heights as rows times columns");
    for (const GeometryPart& part : g.parts) check_arrays(part.geometry);
}

}  // namespace

const Shape& ShapeStore::add(const Geometry& geometry) {
    check_arrays(geometry);
    shapes_.push_back(make(geometry));
    return shapes_.back();
}

Shape ShapeStore::make(const Geometry& g) {
    Shape s{};
    s.kind = g.kind;
    s.half_extents = to_plain(g.half_extents);
    s.radius = g.radius;
    s.half_height = g.half_height;

    if (!g.vertices.empty()) {
        auto& points = points_.emplace_back();
        for (const Vector3d& v : g.vertices) points.push_back(to_plain(v));
        auto& corners = indices_.emplace_back();
        auto& normals = points_.emplace_back();
        for (const auto& face : g.faces) {
            corners.push_back(static_cast<std::uint32_t>(face.size()));
            corners.insert(corners.end(), face.begin(), face.end());
            normals.push_back(to_plain(polygon_normal(g, face.data(), face.size())));
        }
        for (const auto& t : g.triangles) {
            corners.insert(corners.end(), t.begin(), t.end());
            normals.push_back(to_plain(polygon_normal(g, t.data(), 3)));
        }
        s.vertices = points.data();
        s.vertex_count = static_cast<std::uint32_t>(points.size());
        s.faces = corners.data();
        s.face_normals = normals.data();
        s.face_count = static_cast<std::uint32_t>(normals.size());
    }
    if (!g.heights.empty()) {
        s.heights = heights_.emplace_back(g.heights).data();
        s.rows = g.rows, s.columns = g.columns;
        s.spacing_x = g.spacing_x, s.spacing_z = g.spacing_z;
    }
    if (!g.parts.empty()) {
        std::vector<ShapePart> parts;
        for (const GeometryPart& p : g.parts)
            parts.push_back(
                {make(p.geometry), {to_plain(p.local.position), to_plain(p.local.rotation)}});
        s.part_count = static_cast<std::uint32_t>(parts.size());
        s.parts = parts_.emplace_back(std::move(parts)).data();
    }
    return s;
}

}  // namespace plumb
