// SPDX-License-Identifier: MIT
/// Deformables in a line each, and their points in a world.
#pragma once

#include "reader/deformable_shapes.h"
#include "scene/scene.h"
#include "world/world.h"

#include <utility>

namespace plumb::test {

inline DeformableSpec soft(DeformableKind kind, reader::Elements made,
                           const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
    DeformableSpec spec;
    spec.kind = kind;
    spec.points = std::move(made.points);
    for (Eigen::Vector3d& p : spec.points) p += at;
    spec.segments = std::move(made.segments);
    spec.triangles = std::move(made.triangles);
    spec.tetrahedra = std::move(made.tetrahedra);
    return spec;
}

/// A cloth in the plane of x and z about `at`, by cells and edges [m].
inline DeformableSpec sheet(std::array<std::uint32_t, 2> cells, const Eigen::Vector2d& size,
                            const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
    return soft(DeformableKind::cloth, reader::grid_surface(cells, size), at);
}
inline DeformableSpec rope(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                           std::uint32_t segments) {
    return soft(DeformableKind::rope, reader::straight_line(from, to, segments));
}
inline DeformableSpec balloon(double radius, std::uint32_t cells,
                              const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
    return soft(DeformableKind::balloon, reader::ball_surface(radius, cells), at);
}
inline DeformableSpec block(const Eigen::Vector3d& half, std::array<std::uint32_t, 3> cells,
                            const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
    return soft(DeformableKind::solid, reader::box_lattice(half, cells), at);
}

/// Adds a deformable and returns it, to be changed until the next is added.
inline DeformableSpec& add_soft(Scene& scene, DeformableSpec spec) {
    scene.deformables.push_back(std::move(spec));
    return scene.deformables.back();
}

/// Holds a point of a deformable where it is, or where a body is.
inline AttachmentSpec& hold(Scene& scene, std::uint32_t deformable,
                            std::vector<std::uint32_t> points, std::uint32_t body = kNoIndex) {
    AttachmentSpec held;
    held.deformable = deformable;
    held.points = std::move(points);
    held.body = body;
    scene.attachments.push_back(std::move(held));
    return scene.attachments.back();
}

inline ScenePoint point_of(std::uint32_t deformable, std::uint32_t point) {
    ScenePoint p;
    p.deformable = deformable, p.point = point;
    return p;
}
inline ScenePoint on_body(std::uint32_t body, const Eigen::Vector3d& at) {
    ScenePoint p;
    p.body = body, p.position = at;
    return p;
}
inline ScenePoint in_the_world(const Eigen::Vector3d& at) { return on_body(kNoIndex, at); }

/// Adds a link and returns it; without lengths it is a rod.
inline LinkSpec& add_link(Scene& scene, const ScenePoint& a, const ScenePoint& b) {
    LinkSpec link;
    link.a = a, link.b = b;
    scene.links.push_back(link);
    return scene.links.back();
}

}  // namespace plumb::test
