// SPDX-License-Identifier: MIT
#include "surfaces.h"

namespace plumb::test {
Shape mesh(const std::vector<V>& vertices, const std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> corners;
    for (const Triangle& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
    return triangle_mesh(vertices, corners);
}

Shape quad_mesh(double half) {
    return mesh({V(-half, 0, -half), V(-half, 0, half), V(half, 0, half), V(half, 0, -half)},
                {{0, 1, 2}, {0, 2, 3}});
}

Shape roof_mesh(double slope, double half) {
    const double x = half * std::cos(slope), y = -half * std::sin(slope);
    return mesh({V(0, 0, -half), V(0, 0, half), V(-x, y, -half), V(-x, y, half), V(x, y, -half),
                 V(x, y, half)},
                {{2, 3, 1}, {2, 1, 0}, {0, 1, 5}, {0, 5, 4}});
}

Shape cube_mesh(double half, int cells) {
    std::vector<V> vertices;
    std::vector<Triangle> triangles;
    const double step = 2 * half / cells;
    for (int face = 0; face < 6; ++face) {
        const int k = face / 2;
        const double side = face % 2 ? 1 : -1;
        const auto base = static_cast<std::uint32_t>(vertices.size());
        for (int i = 0; i <= cells; ++i)
            for (int j = 0; j <= cells; ++j) {
                V p;
                p[k] = side * half;
                p[(k + 1) % 3] = -half + i * step;
                p[(k + 2) % 3] = -half + j * step;
                vertices.push_back(p);
            }
        const auto id = [&](int i, int j) {
            return base + static_cast<std::uint32_t>(i * (cells + 1) + j);
        };
        for (int i = 0; i < cells; ++i)
            for (int j = 0; j < cells; ++j) {
                Triangle t{id(i, j), id(i + 1, j), id(i + 1, j + 1)},
                    u{id(i, j), id(i + 1, j + 1), id(i, j + 1)};
                if (side < 0) std::swap(t[1], t[2]), std::swap(u[1], u[2]);
                triangles.push_back(t);
                triangles.push_back(u);
            }
    }
    return mesh(vertices, triangles);
}

Shape sphere_mesh(double radius, int rings) {
    std::vector<V> vertices;
    std::vector<Triangle> triangles;
    const int around = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < around; ++j) {
            const double s = M_PI * i / rings, t = 2 * M_PI * j / around;
            // Poles are one place under many names.
            const double r = i == 0 || i == rings ? 0 : radius * std::sin(s);
            vertices.push_back(V(r * std::cos(t), radius * std::cos(s), -r * std::sin(t)));
        }
    const auto id = [&](int i, int j) {
        return static_cast<std::uint32_t>(i * around + j % around);
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < around; ++j) {
            triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
            triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    return mesh(vertices, triangles);
}

Shape mesh_of(const Shape& field) {
    std::vector<V> vertices;
    std::vector<Triangle> triangles;
    for (std::uint32_t r = 0; r < field.rows; ++r)
        for (std::uint32_t c = 0; c < field.columns; ++c)
            vertices.push_back(V((c - 0.5 * (field.columns - 1)) * field.spacing_x,
                                 field.heights[r * field.columns + c],
                                 (r - 0.5 * (field.rows - 1)) * field.spacing_z));
    for (std::uint32_t r = 0; r + 1 < field.rows; ++r)
        for (std::uint32_t c = 0; c + 1 < field.columns; ++c) {
            const std::uint32_t a = r * field.columns + c, b = a + field.columns;
            triangles.push_back({a, b, a + 1});
            triangles.push_back({a + 1, b, b + 1});
        }
    return mesh(vertices, triangles);
}

}  // namespace plumb::test
