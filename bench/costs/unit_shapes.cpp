// SPDX-License-Identifier: MIT
#include "costs/unit_shapes.h"

#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <vector>

namespace plumb::bench {
namespace {

/// What a hull or a mesh points to.
struct Memory {
    std::vector<Vec3> vertices, normals;
    std::vector<std::uint32_t> faces;
    std::vector<double> heights;
};

Memory& fresh_memory() {
    static std::deque<Memory> all;
    return all.emplace_back();
}

Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = minus(b, a), v = minus(c, a);
    const Vec3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return {n.x / length, n.y / length, n.z / length};
}

Shape from(ShapeKind kind, const Memory& m) {
    Shape s{};
    s.kind = kind;
    s.vertices = m.vertices.data();
    s.vertex_count = static_cast<std::uint32_t>(m.vertices.size());
    s.faces = m.faces.data();
    s.face_normals = m.normals.data();
    s.face_count = static_cast<std::uint32_t>(m.normals.size());
    return s;
}

/// Two triangles to a cell of a grid over corner + i u + j v; they face along u × v.
void add_grid(Memory& m, const Vec3& corner, const Vec3& u, const Vec3& v, std::uint32_t cells) {
    const auto first = static_cast<std::uint32_t>(m.vertices.size());
    for (std::uint32_t j = 0; j <= cells; ++j)
        for (std::uint32_t i = 0; i <= cells; ++i)
            m.vertices.push_back({corner.x + i * u.x + j * v.x, corner.y + i * u.y + j * v.y,
                                  corner.z + i * u.z + j * v.z});
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = first + j * (cells + 1) + i, d = a + cells + 1;
            for (const auto& t : {std::array{a, a + 1, d + 1}, std::array{a, d + 1, d}}) {
                m.faces.insert(m.faces.end(), t.begin(), t.end());
                m.normals.push_back(
                    normal_of(m.vertices[t[0]], m.vertices[t[1]], m.vertices[t[2]]));
            }
        }
}

Shape cube_mesh() {
    constexpr std::uint32_t cells = 4;
    constexpr double h = 0.5, d = 1.0 / cells;
    Memory& m = fresh_memory();
    add_grid(m, {h, -h, -h}, {0, d, 0}, {0, 0, d}, cells);
    add_grid(m, {-h, -h, -h}, {0, 0, d}, {0, d, 0}, cells);
    add_grid(m, {-h, h, -h}, {0, 0, d}, {d, 0, 0}, cells);
    add_grid(m, {-h, -h, -h}, {d, 0, 0}, {0, 0, d}, cells);
    add_grid(m, {-h, -h, h}, {d, 0, 0}, {0, d, 0}, cells);
    add_grid(m, {-h, -h, -h}, {0, d, 0}, {d, 0, 0}, cells);
    return from(ShapeKind::mesh, m);
}

/// A prism of six sides about y.
Shape prism() {
    constexpr std::uint32_t sides = 6;
    Memory& m = fresh_memory();
    std::vector<std::uint32_t> top{sides}, bottom{sides};
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        m.vertices.push_back({0.5 * std::cos(angle), -0.5, 0.5 * std::sin(angle)});
        m.vertices.push_back({0.5 * std::cos(angle), 0.5, 0.5 * std::sin(angle)});
        bottom.push_back(2 * i);
        top.push_back(2 * (sides - 1 - i) + 1);
        const std::uint32_t j = (i + 1) % sides;
        for (std::uint32_t corner : {4u, 2 * i, 2 * i + 1, 2 * j + 1, 2 * j})
            m.faces.push_back(corner);
        const double middle = angle + std::numbers::pi / sides;
        m.normals.push_back({std::cos(middle), 0, std::sin(middle)});
    }
    m.faces.insert(m.faces.end(), bottom.begin(), bottom.end());
    m.normals.push_back({0, -1, 0});
    m.faces.insert(m.faces.end(), top.begin(), top.end());
    m.normals.push_back({0, 1, 0});
    return from(ShapeKind::hull, m);
}

}  // namespace

Shape unit_shape(ShapeKind kind) {
    if (kind == ShapeKind::mesh) return cube_mesh();
    if (kind == ShapeKind::hull) return prism();
    Shape s{};
    s.kind = kind;
    s.half_extents = {0.5, 0.5, 0.5};
    s.radius = kind == ShapeKind::capsule ? 0.25 : 0.5;
    s.half_height = kind == ShapeKind::capsule ? 0.25 : 0.5;
    return s;
}

Shape unit_ground(ShapeKind kind) {
    constexpr std::uint32_t cells = 4;
    constexpr double spacing = 0.5;
    if (kind == ShapeKind::mesh) {
        Memory& m = fresh_memory();
        add_grid(m, {-1, 0, -1}, {0, 0, spacing}, {spacing, 0, 0}, cells);
        return from(kind, m);
    }
    Shape s{};
    s.kind = kind;
    if (kind != ShapeKind::height_field) return s;
    Memory& m = fresh_memory();
    s.rows = s.columns = cells + 1;
    m.heights.assign((cells + 1) * (cells + 1), 0.0);
    s.heights = m.heights.data();
    s.spacing_x = s.spacing_z = spacing;
    return s;
}

}  // namespace plumb::bench
