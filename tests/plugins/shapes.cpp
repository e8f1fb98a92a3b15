// SPDX-License-Identifier: MIT
#include "shapes.h"

#include <cmath>
#include <deque>
#include <mutex>

namespace plumb::test {
namespace {

struct Memory {
    std::vector<Vec3> vertices, normals;
    std::vector<std::uint32_t> faces;
    std::vector<ShapePart> parts;
    std::vector<double> heights;
};

/// Memory behind shapes, never moved. Tests make shapes on several threads at once.
Memory& new_memory() {
    static std::mutex lock;
    const std::lock_guard<std::mutex> guard(lock);
    static std::deque<Memory> all;
    return all.emplace_back();
}

Shape with_faces(ShapeKind kind, Memory& m, std::uint32_t face_count, int stride_of_mesh) {
    for (std::size_t i = 0; i < m.faces.size();) {
        const std::uint32_t corners = stride_of_mesh ? 3 : m.faces[i++];
        const V a = v(m.vertices[m.faces[i]]), b = v(m.vertices[m.faces[i + 1]]),
                c = v(m.vertices[m.faces[i + 2]]);
        m.normals.push_back(vec((b - a).cross(c - a).normalized()));
        i += corners;
    }
    Shape s{};
    s.kind = kind;
    s.vertices = m.vertices.data();
    s.vertex_count = static_cast<std::uint32_t>(m.vertices.size());
    s.faces = m.faces.data();
    s.face_count = face_count;
    s.face_normals = m.normals.data();
    return s;
}

}  // namespace

Pose pose(const Place& place) {
    return {vec(place.x), {place.q.x(), place.q.y(), place.q.z(), place.q.w()}};
}

Shape plane() {
    Shape s{};
    s.kind = ShapeKind::plane;
    return s;
}
Shape sphere(double radius) {
    Shape s{};
    s.kind = ShapeKind::sphere;
    s.radius = radius;
    return s;
}
Shape box(double hx, double hy, double hz) {
    Shape s{};
    s.kind = ShapeKind::box;
    s.half_extents = {hx, hy, hz};
    return s;
}
static Shape round(ShapeKind kind, double radius, double half_height) {
    Shape s{};
    s.kind = kind;
    s.radius = radius;
    s.half_height = half_height;
    return s;
}
Shape capsule(double radius, double half_height) {
    return round(ShapeKind::capsule, radius, half_height);
}
Shape cylinder(double radius, double half_height) {
    return round(ShapeKind::cylinder, radius, half_height);
}
Shape cone(double radius, double half_height) {
    return round(ShapeKind::cone, radius, half_height);
}

Shape box_hull(double hx, double hy, double hz) {
    Memory& m = new_memory();
    for (int i = 0; i < 8; ++i)
        m.vertices.push_back({i & 1 ? hx : -hx, i & 2 ? hy : -hy, i & 4 ? hz : -hz});
    m.faces = {4, 0, 2, 3, 1, 4, 4, 5, 7, 6, 4, 0, 1, 5, 4,
               4, 2, 6, 7, 3, 4, 0, 4, 6, 2, 4, 1, 3, 7, 5};
    return with_faces(ShapeKind::hull, m, 6, 0);
}

Shape octahedron(double r) {
    Memory& m = new_memory();
    m.vertices = {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
    m.faces = {3, 0, 2, 4, 3, 2, 1, 4, 3, 1, 3, 4, 3, 3, 0, 4,
               3, 2, 0, 5, 3, 1, 2, 5, 3, 3, 1, 5, 3, 0, 3, 5};
    return with_faces(ShapeKind::hull, m, 8, 0);
}

Shape hull(const std::vector<V>& vertices, const std::vector<std::vector<std::uint32_t>>& faces) {
    Memory& m = new_memory();
    for (const V& p : vertices) m.vertices.push_back(vec(p));
    for (const auto& face : faces) {
        m.faces.push_back(static_cast<std::uint32_t>(face.size()));
        m.faces.insert(m.faces.end(), face.begin(), face.end());
    }
    return with_faces(ShapeKind::hull, m, static_cast<std::uint32_t>(faces.size()), 0);
}

Shape prism(int sides, double radius, double half_height) {
    std::vector<V> vertices;
    std::vector<std::vector<std::uint32_t>> faces(2);
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * M_PI * i / sides;
        const double x = radius * std::cos(angle), z = -radius * std::sin(angle);
        vertices.insert(vertices.end(), {V(x, -half_height, z), V(x, half_height, z)});
        const auto here = static_cast<std::uint32_t>(2 * i);
        const auto next = static_cast<std::uint32_t>(2 * ((i + 1) % sides));
        faces[0].push_back(here + 1);
        faces[1].insert(faces[1].begin(), here);
        faces.push_back({here, next, next + 1, here + 1});
    }
    return hull(vertices, faces);
}

Shape hull_of(const std::vector<V>& points) {
    // Three points make a face where all others lie behind their plane.
    std::vector<std::vector<std::uint32_t>> faces;
    const auto count = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = i + 1; j < count; ++j)
            for (std::uint32_t k = j + 1; k < count; ++k) {
                const V n = (points[j] - points[i]).cross(points[k] - points[i]);
                int before = 0, behind = 0;
                for (std::uint32_t l = 0; l < count; ++l) {
                    if (l == i || l == j || l == k) continue;
                    ++(n.dot(points[l] - points[i]) > 0 ? before : behind);
                }
                if (before == 0) faces.push_back({i, j, k});
                if (behind == 0) faces.push_back({i, k, j});
            }
    return hull(points, faces);
}

Shape triangle_mesh(const std::vector<V>& vertices, const std::vector<std::uint32_t>& triangles) {
    Memory& m = new_memory();
    for (const V& p : vertices) m.vertices.push_back(vec(p));
    m.faces = triangles;
    return with_faces(ShapeKind::mesh, m, static_cast<std::uint32_t>(triangles.size() / 3), 3);
}

Shape box_mesh(double hx, double hy, double hz) {
    std::vector<V> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back({i & 1 ? hx : -hx, i & 2 ? hy : -hy, i & 4 ? hz : -hz});
    return triangle_mesh(corners, {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5});
}

Shape height_field(double half, int cells, const std::function<double(double, double)>& height) {
    Memory& m = new_memory();
    Shape s{};
    s.kind = ShapeKind::height_field;
    s.rows = s.columns = static_cast<std::uint32_t>(cells + 1);
    s.spacing_x = s.spacing_z = 2 * half / cells;
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column)
            m.heights.push_back(height(-half + column * s.spacing_x, -half + row * s.spacing_z));
    s.heights = m.heights.data();
    return s;
}

Shape grid_mesh(double half, int cells) {
    Memory& m = new_memory();
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j)
            m.vertices.push_back({-half + 2 * half * i / cells, 0, -half + 2 * half * j / cells});
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            const auto a = static_cast<std::uint32_t>(i * (cells + 1) + j), b = a + 1;
            const auto c = a + static_cast<std::uint32_t>(cells) + 1, d = c + 1;
            for (auto k : {a, b, d, a, d, c}) m.faces.push_back(k);
        }
    return with_faces(ShapeKind::mesh, m, static_cast<std::uint32_t>(2 * cells * cells), 3);
}

Shape torus_mesh(double major, double minor, int around, int across) {
    Memory& m = new_memory();
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double s = 2 * M_PI * i / around, t = 2 * M_PI * j / across,
                         r = major + minor * std::cos(t);
            m.vertices.push_back({r * std::cos(s), minor * std::sin(t), -r * std::sin(s)});
        }
    const auto id = [&](int i, int j) {
        return static_cast<std::uint32_t>((i % around) * across + j % across);
    };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j)
            for (auto k : {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j), id(i + 1, j + 1),
                           id(i, j + 1)})
                m.faces.push_back(k);
    return with_faces(ShapeKind::mesh, m, static_cast<std::uint32_t>(2 * around * across), 3);
}

Shape compound(const std::vector<std::pair<Shape, Place>>& parts) {
    Memory& m = new_memory();
    for (const auto& [shape, place] : parts) m.parts.push_back({shape, pose(place)});
    Shape s{};
    s.kind = ShapeKind::compound;
    s.parts = m.parts.data();
    s.part_count = static_cast<std::uint32_t>(m.parts.size());
    return s;
}

}  // namespace plumb::test
