// SPDX-License-Identifier: MIT
#include "step/surface_detector.h"

#include "math/triangle.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Points of one surface keep at most this share of their distance at rest, so that neighbours do
/// not push each other.
constexpr double kShareAtRest = 0.9;
/// Two triangles whose directions differ by more than this cosine both hold a point off.
constexpr double kSameSide = 0.7;

bool may_meet(std::uint32_t group_a, std::uint32_t mask_a, std::uint32_t group_b,
              std::uint32_t mask_b) {
    return (group_a & mask_b) != 0 && (group_b & mask_a) != 0;
}

Vector3d place_of(const World& world, const WorldPoint& p) {
    return p.particle != kNoIndex ? world.particles.position[p.particle]
                                  : in_world(world.bodies, p.body, p.position);
}
double speed_of(const World& world, const WorldPoint& p) {
    if (p.particle != kNoIndex) return world.particles.velocity[p.particle].norm();
    return world.bodies.velocity[p.body].norm() +
           world.bodies.angular_velocity[p.body].norm() * p.position.norm();
}

}  // namespace

SurfaceDetector::SurfaceDetector(const World& world) {
    for (std::uint32_t i = 0; i < world.deformables.size(); ++i) {
        const Deformable& d = world.deformables[i];
        closed_.push_back(d.spec.kind == DeformableKind::balloon ||
                          d.spec.kind == DeformableKind::solid);
        for (const auto& t : d.spec.triangles)
            triangles_.push_back({{d.first + t[0], d.first + t[1], d.first + t[2]}, i});
    }
    if (!triangles_.empty()) add_probes(world);
    low_.resize(triangles_.size()), high_.resize(triangles_.size());
}

void SurfaceDetector::add_probes(const World& world) {
    for (std::uint32_t i = 0; i < world.deformables.size(); ++i) {
        const Deformable& d = world.deformables[i];
        std::vector<std::uint8_t> outside(d.count, d.spec.kind == DeformableKind::rope);
        for (const auto& t : d.spec.triangles)
            for (const std::uint32_t p : t) outside[p] = 1;
        for (std::uint32_t p = 0; p < d.count; ++p) {
            Probe probe;
            probe.point.particle = d.first + p, probe.deformable = i;
            probe.radius = world.particles.radius[d.first + p];
            if (outside[p]) probes_.push_back(probe);
        }
    }
    const Bodies& b = world.bodies;
    for (std::uint32_t i = 0; i < b.size(); ++i) {
        if (b.geometry[i] == kNoIndex) continue;
        for (const CornerPoint& corner : corner_points(world.shapes[b.geometry[i]])) {
            Probe probe;
            const Placement& local = b.geometry_in_body[i];
            probe.point.body = i;
            probe.point.position = local.position + local.rotation * corner.position;
            probe.radius = corner.radius;
            probes_.push_back(probe);
        }
    }
}

void SurfaceDetector::detect(World& world, double dt) {
    world.surface_contacts.clear();
    if (triangles_.empty()) return;
    const Particles& p = world.particles;
    double widest = 0, fastest = 0;
    for (const Probe& probe : probes_) {
        widest = std::max(widest, probe.radius);
        fastest = std::max(fastest, speed_of(world, probe.point));
    }
    const double margin = world.settings.margin + fastest * dt;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const auto& [a, b, c] = triangles_[i].corners;
        const double grown = widest + p.radius[a] + margin;
        const Vector3d by = Vector3d::Constant(std::isfinite(grown) ? grown : 0);
        low_[i] = p.position[a].cwiseMin(p.position[b]).cwiseMin(p.position[c]) - by;
        high_[i] = p.position[a].cwiseMax(p.position[b]).cwiseMax(p.position[c]) + by;
    }
    grid_.build(low_, high_);
    for (const Probe& probe : probes_) look(world, probe, place_of(world, probe.point), margin);
}

void SurfaceDetector::look(World& world, const Probe& probe, const Vector3d& place, double reach) {
    const Particles& p = world.particles;
    near_.clear();
    grid_.each_near(place, [&](std::uint32_t i) {
        if ((place.array() < low_[i].array()).any() || (place.array() > high_[i].array()).any())
            return;
        const Triangle& t = triangles_[i];
        const DeformableSpec& spec = world.deformables[t.deformable].spec;
        if (probe.deformable == kNoIndex) {
            const std::uint32_t body = probe.point.body;
            if (!may_meet(world.bodies.group[body], world.bodies.mask[body], spec.group, spec.mask))
                return;
        } else {
            const DeformableSpec& other = world.deformables[probe.deformable].spec;
            if (!may_meet(other.group, other.mask, spec.group, spec.mask)) return;
            if (std::find(t.corners.begin(), t.corners.end(), probe.point.particle) !=
                t.corners.end())
                return;
        }
        const Vector3d corners[3] = {p.position[t.corners[0]], p.position[t.corners[1]],
                                     p.position[t.corners[2]]};
        const auto w = nearest_weights(place, corners[0], corners[1], corners[2]);
        const Vector3d apart = place - (w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2]);
        const double distance = apart.norm();
        if (distance <= reach + probe.radius + p.radius[t.corners[0]])
            near_.push_back({i, w, apart, distance});
    });
    keep_nearest(world, probe);
}

/// Of each surface the nearest triangle, and the next that lies in another direction.
void SurfaceDetector::keep_nearest(World& world, const Probe& probe) {
    std::sort(near_.begin(), near_.end(), [&](const Near& x, const Near& y) {
        const std::uint32_t a = triangles_[x.triangle].deformable,
                            b = triangles_[y.triangle].deformable;
        if (a != b) return a < b;
        return x.distance != y.distance ? x.distance < y.distance : x.triangle < y.triangle;
    });
    const Particles& p = world.particles;
    std::uint32_t surface = kNoIndex, kept = 0;
    Vector3d direction = Vector3d::Zero();
    for (const Near& n : near_) {
        const Triangle& t = triangles_[n.triangle];
        if (t.deformable != surface) surface = t.deformable, kept = 0;
        if (kept == 2) continue;
        const Vector3d face = (p.position[t.corners[1]] - p.position[t.corners[0]])
                                  .cross(p.position[t.corners[2]] - p.position[t.corners[0]]);
        const bool is_own = probe.deformable == surface;
        const bool is_inside = closed_[surface] && !is_own && n.apart.dot(face) < 0;
        // deep inside nobody can tell where it came from
        if (is_inside && n.distance > std::sqrt(face.norm())) continue;
        Vector3d normal =
            n.distance > 1e-9 ? Vector3d(n.apart / n.distance) : Vector3d(face.normalized());
        if (is_inside) normal = -normal;
        if (!normal.allFinite() || (kept == 1 && normal.dot(direction) > kSameSide)) continue;
        double distance = probe.radius + p.radius[t.corners[0]];
        if (is_own) {
            const Deformable& d = world.deformables[surface];
            Vector3d rest = d.spec.points[probe.point.particle - d.first];
            for (int k = 0; k < 3; ++k)
                rest -= n.weights[k] * d.spec.points[t.corners[k] - d.first];
            distance = std::min(distance, kShareAtRest * rest.norm());
        }
        const std::uint32_t material = probe.point.particle != kNoIndex
                                           ? p.material[probe.point.particle]
                                           : world.bodies.material[probe.point.body];
        const double friction = world.surface_of(material, p.material[t.corners[0]]).friction;
        world.surface_contacts.push_back(
            {probe.point, t.corners, n.weights, normal, distance, friction});
        direction = normal, ++kept;
    }
}

}  // namespace plumb
