// SPDX-License-Identifier: MIT
#include "output/triangles.h"

#include <cmath>
#include <numbers>

namespace plumb {
namespace {

constexpr std::uint32_t kAround = 96;     // corners of a round shape's outline
constexpr std::uint32_t kHalfRings = 16;  // from the end of a capsule to its segment

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

TriangleMesh box(const Eigen::Vector3d& half_extents) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        mesh.vertices.push_back(sign.cwiseProduct(half_extents).cast<float>());
    }
    mesh.triangles =
        fans({{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
    return mesh;
}

/// A point of the outline that is turned about y.
struct OutlinePoint {
    double radius, y;  ///< [m]
};

/// The body of revolution of an outline that runs from the bottom to the top, both on the axis.
TriangleMesh turned(const std::vector<OutlinePoint>& outline) {
    TriangleMesh mesh;
    for (const OutlinePoint& point : outline) {
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const double angle = 2 * std::numbers::pi * i / kAround;
            mesh.vertices.emplace_back(Eigen::Vector3d(point.radius * std::sin(angle), point.y,
                                                       point.radius * std::cos(angle))
                                           .cast<float>());
        }
    }
    for (std::uint32_t ring = 0; ring + 1 < outline.size(); ++ring) {
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t a = ring * kAround + i, b = ring * kAround + (i + 1) % kAround;
            mesh.triangles.push_back({a, b, b + kAround});
            mesh.triangles.push_back({a, b + kAround, a + kAround});
        }
    }
    return mesh;
}

TriangleMesh capsule(double radius, double half_height) {
    std::vector<OutlinePoint> outline;
    for (std::uint32_t i = 0; i <= 2 * kHalfRings; ++i) {
        const double angle = std::numbers::pi * (static_cast<double>(i) / (2 * kHalfRings) - 0.5);
        const double end = i < kHalfRings ? -half_height : half_height;
        if (i == kHalfRings) outline.push_back({radius, -half_height});
        outline.push_back({radius * std::cos(angle), end + radius * std::sin(angle)});
    }
    return turned(outline);
}

/// Hull and mesh: what the user gave.
TriangleMesh given(const Geometry& geometry) {
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

}  // namespace

TriangleMesh triangles_of(const Geometry& g) {
    switch (g.kind) {
        case ShapeKind::box:
            return box(g.half_extents);
        case ShapeKind::capsule:
            return capsule(g.radius, g.half_height);
        case ShapeKind::cylinder:
            return turned({{0, -g.half_height},
                           {g.radius, -g.half_height},
                           {g.radius, g.half_height},
                           {0, g.half_height}});
        case ShapeKind::cone:
            return turned({{0, -g.half_height}, {g.radius, -g.half_height}, {0, g.half_height}});
        case ShapeKind::height_field:
            return height_field(g);
        case ShapeKind::hull:
        case ShapeKind::mesh:
            return given(g);
        case ShapeKind::plane:
        case ShapeKind::sphere:
        case ShapeKind::compound:
            break;
    }
    return {};
}

}  // namespace plumb
