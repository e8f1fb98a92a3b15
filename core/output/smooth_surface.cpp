// SPDX-License-Identifier: MIT
#include "output/smooth_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace plumb {
namespace {

using Vector = Eigen::Vector3f;

/// As long as twice the triangle's area.
Vector area_normal(const TriangleMesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Vector& p = mesh.vertices[a];
    return (mesh.vertices[b] - p).cross(mesh.vertices[c] - p);
}

}  // namespace

double crease_cosine(DeformableKind kind) { return kind == DeformableKind::solid ? 0.7 : -2; }

SmoothSurface::SmoothSurface(TriangleMesh mesh, double crease_cosine) : mesh_(std::move(mesh)) {
    std::vector<Vector> flat(mesh_.triangles.size());
    std::vector<std::vector<std::size_t>> about(mesh_.vertices.size());
    for (std::size_t t = 0; t < flat.size(); ++t) {
        flat[t] = area_normal(mesh_, t);
        for (const std::uint32_t corner : mesh_.triangles[t]) about[corner].push_back(t);
    }
    const auto least = static_cast<float>(crease_cosine);
    normals_.resize(flat.size());
    for (std::size_t t = 0; t < flat.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            Vector sum = Vector::Zero();
            for (const std::size_t other : about[mesh_.triangles[t][k]])
                if (flat[t].dot(flat[other]) >= least * flat[t].norm() * flat[other].norm())
                    sum += flat[other];
            normals_[t][k] = sum.normalized();
        }
    }
}

SmoothSurface::Look SmoothSurface::look(const Place& place, const Vector& direction) const {
    const std::array<float, 3> shares{1 - place.u - place.v, place.u, place.v};
    const float side = area_normal(mesh_, place.triangle).dot(direction) > 0 ? -1 : 1;
    Vector point = Vector::Zero(), normal = Vector::Zero(), lift = Vector::Zero();
    for (std::size_t k = 0; k < 3; ++k)
        point += shares[k] * mesh_.vertices[mesh_.triangles[place.triangle][k]];
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector n = side * normals_[place.triangle][k];
        const Vector& corner = mesh_.vertices[mesh_.triangles[place.triangle][k]];
        normal += shares[k] * n;
        lift -= shares[k] * std::min(0.0f, n.dot(point - corner)) * n;
    }
    return {normal.normalized(), point + lift};
}

std::optional<SmoothSurface> surface_of(const RecordedDeformable& deformable, const Frame& frame,
                                        const Eigen::Vector3d& middle) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < deformable.count; ++i)
        mesh.vertices.push_back((frame.particles[deformable.first + i] - middle).cast<float>());
    for (const auto& triangle : triangles_in(deformable, frame)) {
        const bool finite = std::all_of(
            triangle.begin(), triangle.end(),
            [&mesh](std::uint32_t corner) { return mesh.vertices[corner].allFinite(); });
        if (finite) mesh.triangles.push_back(triangle);
    }
    if (mesh.triangles.empty()) return std::nullopt;
    return SmoothSurface(std::move(mesh), crease_cosine(deformable.kind));
}

}  // namespace plumb
