// SPDX-License-Identifier: MIT
#include "output/triangles.h"

namespace plumb {
namespace {

std::vector<std::array<std::uint32_t, 3>> fans(
    const std::vector<std::vector<std::uint32_t>>& polygons) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const std::vector<std::uint32_t>& polygon : polygons) {
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
        }
    }
    return triangles;
}

TriangleMesh height_field(const Geometry& g) {
    TriangleMesh mesh;
    if (g.rows < 2 || g.columns < 2) return mesh;
    if (g.heights.size() < std::size_t{g.rows} * g.columns) return mesh;
    for (std::uint32_t row = 0; row < g.rows; ++row) {
        for (std::uint32_t column = 0; column < g.columns; ++column) {
            const double x = (column - 0.5 * (g.columns - 1)) * g.spacing_x;
            const double z = (row - 0.5 * (g.rows - 1)) * g.spacing_z;
            const double y = g.heights[std::size_t{row} * g.columns + column];
            mesh.vertices.push_back(Eigen::Vector3d(x, y, z).cast<float>());
        }
    }
    for (std::uint32_t row = 0; row + 1 < g.rows; ++row) {
        for (std::uint32_t column = 0; column + 1 < g.columns; ++column) {
            const std::uint32_t a = row * g.columns + column, b = a + g.columns;
            mesh.triangles.push_back({a, b, a + 1});
            mesh.triangles.push_back({a + 1, b, b + 1});
        }
    }
    return mesh;
}

}  // namespace

TriangleMesh triangles_of(const Geometry& geometry) {
    if (geometry.kind == ShapeKind::height_field) return height_field(geometry);
    TriangleMesh mesh;
    for (const Eigen::Vector3d& v : geometry.vertices) mesh.vertices.push_back(v.cast<float>());
    mesh.triangles = geometry.kind == ShapeKind::hull ? fans(geometry.faces) : geometry.triangles;
    std::erase_if(mesh.triangles, [&mesh](const std::array<std::uint32_t, 3>& triangle) {
        for (const std::uint32_t corner : triangle) {
            if (corner >= mesh.vertices.size()) return true;
        }
        return false;
    });
    return mesh;
}

}  // namespace plumb
