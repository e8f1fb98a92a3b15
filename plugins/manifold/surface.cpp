// SPDX-License-Identifier: MIT
#include "manifold/surface.h"

#include "manifold/triangle.h"

#include <numeric>
#include <tuple>

namespace plumb {
namespace {

/// [vertex] the first vertex in the same place.
std::vector<std::uint32_t> first_in_place(const Vec3* vertices, std::uint32_t count) {
    std::vector<std::uint32_t> order(count), first(count);
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        return std::tie(vertices[i].x, vertices[i].y, vertices[i].z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        return key(i) < key(j) || (key(i) == key(j) && i < j);
    });
    for (std::uint32_t i = 0; i < count; ++i)
        first[order[i]] =
            i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
    return first;
}

}  // namespace

Surface::Surface(const Shape& shape) {
    if (shape.kind == ShapeKind::height_field)
        take_height_field(shape);
    else
        take_mesh(shape);
    join_edges();
    weigh_vertices();
    for (const Triangle& t : triangles_) topology_.add(t.corner, t.number, t.normal);
    topology_.connect(vertices_);
    std::vector<Aabb> boxes(triangles_.size());
    for (std::uint32_t t = 0; t < size(); ++t) boxes[t] = box_of(t);
    tree_ = BoxTree(boxes);
}

void Surface::take_mesh(const Shape& mesh) {
    vertices_.assign(mesh.vertices, mesh.vertices + mesh.vertex_count);
    const std::vector<std::uint32_t> same = first_in_place(mesh.vertices, mesh.vertex_count);
    for (std::uint32_t t = 0; t < mesh.face_count; ++t) {
        const std::uint32_t* c = mesh.faces + 3 * t;
        add(same[c[0]], same[c[1]], same[c[2]], t);
    }
}

void Surface::take_height_field(const Shape& field) {
    for (std::uint32_t row = 0; row < field.rows; ++row)
        for (std::uint32_t column = 0; column < field.columns; ++column)
            vertices_.push_back({(column - 0.5 * (field.columns - 1)) * field.spacing_x,
                                 field.heights[std::size_t{row} * field.columns + column],
                                 (row - 0.5 * (field.rows - 1)) * field.spacing_z});
    std::uint32_t number = 0;
    for (std::uint32_t row = 0; row + 1 < field.rows; ++row)
        for (std::uint32_t column = 0; column + 1 < field.columns; ++column) {
            const std::uint32_t a = row * field.columns + column, b = a + field.columns;
            add(a, b, a + 1, number++);
            add(a + 1, b, b + 1, number++);
        }
}

void Surface::add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t number) {
    // Two corners in one place: the edges cancel each other, so nothing opens without the triangle.
    if (a == b || b == c || c == a) return;
    const Vec3 n = cross(vertices_[b] - vertices_[a], vertices_[c] - vertices_[a]);
    const double twice_area = norm(n);
    triangles_.push_back(
        {{a, b, c}, number, twice_area > 0 ? (1 / twice_area) * n : Vec3{0, 0, 0}, {}});
}

void Surface::join_edges() {
    struct Edge {
        std::uint32_t low, high, triangle;
        int k;
        bool upwards;
    };
    std::vector<Edge> edges;
    for (std::uint32_t t = 0; t < size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = triangles_[t].corner[k],
                                to = triangles_[t].corner[(k + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
        }
    const auto ends = [](const Edge& e) { return std::tie(e.low, e.high); };
    std::sort(edges.begin(), edges.end(), [&](const Edge& p, const Edge& q) {
        return std::tie(p.low, p.high, p.triangle) < std::tie(q.low, q.high, q.triangle);
    });

    closed_ = !edges.empty();
    for (std::size_t i = 0; i < edges.size();) {
        Vec3 sum{};
        int balance = 0;
        std::size_t end = i;
        for (; end < edges.size() && ends(edges[end]) == ends(edges[i]); ++end) {
            sum = sum + triangles_[edges[end].triangle].normal;
            balance += edges[end].upwards ? 1 : -1;
        }
        closed_ = closed_ && balance == 0;
        for (; i < end; ++i) {
            Triangle& t = triangles_[edges[i].triangle];
            t.edge_normal[edges[i].k] = unit_or(sum, t.normal);
        }
    }
}

void Surface::weigh_vertices() {
    vertex_normals_.assign(vertices_.size(), Vec3{0, 0, 0});
    for (const Triangle& t : triangles_)
        for (int k = 0; k < 3; ++k) {
            const Vec3& p = vertices_[t.corner[k]];
            const Vec3 d = vertices_[t.corner[(k + 1) % 3]] - p;
            const Vec3 e = vertices_[t.corner[(k + 2) % 3]] - p;
            const double angle = std::atan2(norm(cross(d, e)), dot(d, e));
            vertex_normals_[t.corner[k]] = vertex_normals_[t.corner[k]] + angle * t.normal;
        }
    for (Vec3& n : vertex_normals_) n = unit_or(n, {0, 1, 0});
}

Aabb Surface::box_of(std::uint32_t triangle) const {
    const Vec3 &p = corner(triangle, 0), &q = corner(triangle, 1), &r = corner(triangle, 2);
    Aabb box{};
    for (int k = 0; k < 3; ++k) {
        at(box.low, k) = std::min({at(p, k), at(q, k), at(r, k)});
        at(box.high, k) = std::max({at(p, k), at(q, k), at(r, k)});
    }
    return box;
}

NearestPoint Surface::nearest(Vec3 p, double within) const {
    NearestPoint best;
    best.squared = within * within;
    TrianglePoint best_on{};
    std::uint32_t best_index = 0;
    const auto visit = [&](std::uint32_t t) {
        const TrianglePoint on = nearest_on_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2));
        const Vec3 d = p - on.point;
        const double squared = dot(d, d);
        const bool nearer =
            squared < best.squared || (squared == best.squared && (!best.found || t < best_index));
        if (!nearer) return;
        best.squared = squared;
        best.found = true;
        best_on = on;
        best_index = t;
    };
    tree_.near(
        {p, p}, [&] { return best.squared; }, visit);
    if (!best.found) return best;
    const Triangle& t = triangles_[best_index];
    best.point = best_on.point;
    best.triangle = t.number;
    best.pseudonormal = best_on.vertex >= 0 ? vertex_normals_[t.corner[best_on.vertex]]
                        : best_on.edge >= 0 ? t.edge_normal[best_on.edge]
                                            : t.normal;
    return best;
}

SurfaceHit Surface::hit(const Ray& ray, double length) const {
    SurfaceHit best;
    best.distance = length;
    tree_.along(
        ray, [&] { return best.distance; },
        [&](std::uint32_t t) {
            const double distance = ray_to_triangle(ray.origin, ray.direction, corner(t, 0),
                                                    corner(t, 1), corner(t, 2));
            if (!std::isfinite(distance)) return;
            const std::uint32_t number = triangles_[t].number;
            const bool first =
                distance < best.distance ||
                (distance == best.distance && (!best.found || number < best.triangle));
            if (first) best = {distance, triangles_[t].normal, number, true};
        });
    return best;
}

std::shared_ptr<const Surface> SurfaceStore::of(const Shape& shape) {
    std::erase_if(entries_, [](const Entry& e) { return e.surface.expired(); });
    const void* key = shape.kind == ShapeKind::height_field
                          ? static_cast<const void*>(shape.heights)
                          : static_cast<const void*>(shape.faces);
    for (const Entry& e : entries_)
        if (e.key == key) return e.surface.lock();
    auto made = std::make_shared<const Surface>(shape);
    entries_.push_back({key, made});
    return made;
}

}  // namespace plumb
