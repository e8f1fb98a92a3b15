// SPDX-License-Identifier: MIT
/// Deformables in a line each, for programs that make their own scenes (scene/build.h has bodies).
#pragma once

#include "reader/deformables/deformable_shapes.h"
#include "scene/scene.h"

#include <utility>

namespace plumb::reader {

inline DeformableSpec soft(DeformableKind kind, Elements made,
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
    return soft(DeformableKind::cloth, grid_surface(cells, size), at);
}
inline DeformableSpec rope(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                           std::uint32_t segments) {
    return soft(DeformableKind::rope, straight_line(from, to, segments));
}
inline DeformableSpec balloon(double radius, std::uint32_t cells,
                              const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
    return soft(DeformableKind::balloon, ball_surface(radius, cells), at);
}
inline DeformableSpec block(const Eigen::Vector3d& half, std::array<std::uint32_t, 3> cells,
                            const Eigen::Vector3d& at = Eigen::Vector3d::Zero(),
                            CellCut cut = CellCut::five) {
    return soft(DeformableKind::solid, box_lattice(half, cells, cut), at);
}

/// Adds a deformable and returns it, to be changed until the next is added.
inline DeformableSpec& add_soft(Scene& scene, DeformableSpec spec) {
    scene.deformables.push_back(std::move(spec));
    return scene.deformables.back();
}

/// Holds points of a deformable where they are, or where they are on a body.
inline AttachmentSpec& hold(Scene& scene, std::uint32_t deformable,
                            std::vector<std::uint32_t> points, std::uint32_t body = kNoIndex) {
    AttachmentSpec held;
    held.deformable = deformable;
    held.points = std::move(points);
    held.body = body;
    scene.attachments.push_back(std::move(held));
    return scene.attachments.back();
}

}  // namespace plumb::reader
