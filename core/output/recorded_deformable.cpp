// SPDX-License-Identifier: MIT
#include "output/recorded_deformable.h"

#include "geometry/outer_faces.h"
#include "scene/elements_left.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Those elements whose points exist.
template <std::size_t N>
std::vector<std::array<std::uint32_t, N>> sound(std::vector<std::array<std::uint32_t, N>> elements,
                                                std::size_t points) {
    std::erase_if(elements, [points](const std::array<std::uint32_t, N>& element) {
        return std::any_of(element.begin(), element.end(),
                           [points](std::uint32_t point) { return point >= points; });
    });
    return elements;
}

double size_of(const std::vector<Eigen::Vector3d>& points) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : points)
        if (point.allFinite()) box.extend(point);
    return box.isEmpty() ? 0 : box.sizes().maxCoeff();
}

std::vector<std::uint32_t> torn_of(const RecordedDeformable& deformable, const Frame& frame) {
    std::vector<std::uint32_t> torn;
    for (const auto& [owner, element] : frame.torn)
        if (owner == deformable.index) torn.push_back(element);
    return torn;
}

RecordedPoint recorded_point(const Scene& scene, const std::vector<RecordedDeformable>& deformables,
                             const ScenePoint& point) {
    RecordedPoint result;
    if (point.deformable < deformables.size()) {
        result.particle = deformables[point.deformable].first + point.point;
    } else if (point.body < scene.bodies.size()) {
        const Placement& body = scene.bodies[point.body].placement;
        result.body = point.body;
        result.place = body.rotation.conjugate() * Eigen::Vector3d(point.position - body.position);
    } else {
        result.place = point.position;
    }
    return result;
}

}  // namespace

std::vector<RecordedDeformable> recorded_deformables(const Scene& scene) {
    std::vector<RecordedDeformable> result;
    std::uint32_t first = 0;
    for (const DeformableSpec& spec : scene.deformables) {
        RecordedDeformable deformable;
        deformable.name = spec.name;
        deformable.kind = spec.kind;
        deformable.index = static_cast<std::uint32_t>(result.size());
        deformable.first = first;
        deformable.count = static_cast<std::uint32_t>(spec.points.size());
        if (spec.kind == DeformableKind::rope)
            deformable.segments = sound(spec.segments, spec.points.size());
        else if (spec.kind == DeformableKind::solid && spec.triangles.empty())
            deformable.triangles = sound(outer_faces(spec.tetrahedra), spec.points.size());
        else
            deformable.triangles = sound(spec.triangles, spec.points.size());
        deformable.thickness = spec.thickness;
        deformable.radius = spec.radius;
        deformable.size = size_of(spec.points);
        deformable.color = spec.color;
        deformable.tears = std::isfinite(spec.tearing_strain);
        if (deformable.tears) deformable.tetrahedra = sound(spec.tetrahedra, spec.points.size());
        first += deformable.count;
        result.push_back(std::move(deformable));
    }
    return result;
}

std::vector<RecordedLink> recorded_links(const Scene& scene) {
    const std::vector<RecordedDeformable> deformables = recorded_deformables(scene);
    std::vector<RecordedLink> links;
    for (const LinkSpec& link : scene.links)
        links.push_back({recorded_point(scene, deformables, link.a),
                         recorded_point(scene, deformables, link.b)});
    return links;
}

std::size_t particle_count(const std::vector<RecordedDeformable>& deformables) {
    std::size_t count = 0;
    for (const RecordedDeformable& deformable : deformables) count += deformable.count;
    return count;
}

std::size_t element_count(const RecordedDeformable& deformable) {
    switch (deformable.kind) {
        case DeformableKind::rope:
            return deformable.segments.size();
        case DeformableKind::solid:
            return deformable.tetrahedra.size();
        default:
            return deformable.triangles.size();
    }
}

std::vector<std::array<std::uint32_t, 2>> segments_in(const RecordedDeformable& deformable,
                                                      const Frame& frame) {
    return elements_left(deformable.segments, torn_of(deformable, frame));
}

std::vector<std::array<std::uint32_t, 3>> triangles_in(const RecordedDeformable& deformable,
                                                       const Frame& frame) {
    const std::vector<std::uint32_t> torn = torn_of(deformable, frame);
    if (torn.empty()) return deformable.triangles;
    return deformable.kind == DeformableKind::solid
               ? outer_faces(elements_left(deformable.tetrahedra, torn))
               : elements_left(deformable.triangles, torn);
}

Eigen::Vector3d place_of(const RecordedPoint& point, const Frame& frame) {
    if (point.particle < frame.particles.size()) return frame.particles[point.particle];
    if (point.body >= frame.bodies.size()) return point.place;
    const Placement& body = frame.bodies[point.body].placement;
    return body.position + body.rotation * point.place;
}

}  // namespace plumb
