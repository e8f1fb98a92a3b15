// SPDX-License-Identifier: MIT
#include "manifold/mesh_side.h"

#include "manifold/triangle.h"

namespace plumb {
MeshSide::MeshSide(const Part& part)
    : part_(part),
      surface_(*part.surface),
      slack_(1e-8 * norm(part.own_bounds.high - part.own_bounds.low)) {}

bool MeshSide::holds(Vec3 p, const NearestPoint& near) const {
    if (!near.found) return false;
    const double side = dot(to_inner(part_.world, p) - near.point, near.pseudonormal);
    const double distance = std::sqrt(near.squared);
    return distance > slack_ && side < (surface_.closed() ? 0 : -0.5 * distance);
}

bool MeshSide::is_free(Vec3 p, Vec3 n, double length) const {
    const Ray ray = make_ray(to_inner(part_.world, p), turned_back(part_.world, n));
    const double before = length - slack_;
    bool free = true;
    const auto limit = [&] { return free ? before : -1.0; };
    surface_.tree().along(ray, limit, [&](std::uint32_t t) {
        // Along a face the ray meets nothing but rounding.
        if (std::abs(dot(surface_.normal(t), ray.direction)) < 1e-6) return;
        const double hit = ray_to_triangle(ray.origin, ray.direction, surface_.corner(t, 0),
                                           surface_.corner(t, 1), surface_.corner(t, 2));
        if (hit < before) free = false;
    });
    return free;
}

bool MeshSide::sticks_out(std::uint32_t vertex, Vec3 d, double lean) const {
    const MeshTopology& mesh = topology();
    const Vec3 own = turned_back(part_.world, d), p = mesh.vertices[vertex];
    for (std::uint32_t i = mesh.ring_begin[vertex]; i < mesh.ring_begin[vertex + 1]; ++i) {
        const Vec3 way = mesh.vertices[mesh.ring[i]] - p;
        if (dot(way, own) > lean * norm(way)) return false;
    }
    return true;
}

Aabb box_between(const Frame& from, const Frame& to, const Aabb& box) {
    const Vec3 middle = to_inner(to, to_outer(from, 0.5 * (box.low + box.high)));
    const Vec3 half = 0.5 * (box.high - box.low);
    Vec3 reach{};
    for (int k = 0; k < 3; ++k) {
        const Vec3 axis = turned_back(to, from.axis[k]);
        for (int i = 0; i < 3; ++i) at(reach, i) += std::abs(at(axis, i)) * at(half, k);
    }
    return {middle - reach, middle + reach};
}

}  // namespace plumb
