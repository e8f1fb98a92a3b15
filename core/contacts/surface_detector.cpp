// SPDX-License-Identifier: MIT
#include "contacts/surface_detector.h"

#include "geometry/triangle.h"
#include "world/point_place.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Points of one surface keep at most this share of their distance at rest, so that neighbours do
/// not push each other.
constexpr double kShareAtRest = 0.9;
/// Two triangles whose directions differ by more than this cosine both hold a point off.
constexpr double kSameSide = 0.7;
/// Room for triangles near one point.
constexpr std::size_t kUsuallyNear = 1024;
/// From this cosine on, a point faces a triangle and not only its rim.
constexpr double kFaceOn = 0.99;

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
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const auto& [a, b, c] = triangles_[i].corners;
        const double fastest =
            std::max({p.velocity[a].norm(), p.velocity[b].norm(), p.velocity[c].norm()});
        const double grown = p.radius[a] + world.settings.margin + fastest * dt;
        const Vector3d by = Vector3d::Constant(std::isfinite(grown) ? grown : 0);
        low_[i] = p.position[a].cwiseMin(p.position[b]).cwiseMin(p.position[c]) - by;
        high_[i] = p.position[a].cwiseMax(p.position[b]).cwiseMax(p.position[c]) + by;
    }
    world.surface_contacts.reserve(2 * probes_.size());
    near_.reserve(kUsuallyNear);
    grid_.build(low_, high_);
    bounds_low_ = low_[0], bounds_high_ = high_[0];
    for (std::size_t i = 1; i < triangles_.size(); ++i) {
        bounds_low_ = bounds_low_.cwiseMin(low_[i]);
        bounds_high_ = bounds_high_.cwiseMax(high_[i]);
    }
    for (const Probe& probe : probes_) look(world, probe, dt);
}

void SurfaceDetector::look(World& world, const Probe& probe, double dt) {
    const Particles& p = world.particles;
    const Vector3d place = place_of(world, probe.point);
    const double slack = probe.radius + speed_of(world, probe.point) * dt;
    const Vector3d low = place - Vector3d::Constant(slack),
                   high = place + Vector3d::Constant(slack);
    if (!low.allFinite() || !high.allFinite() || (high.array() < bounds_low_.array()).any() ||
        (low.array() > bounds_high_.array()).any())
        return;
    near_.clear();
    grid_.each_near(low, high, [&](std::uint32_t i) {
        if ((high.array() < low_[i].array()).any() || (low.array() > high_[i].array()).any())
            return;
        const Triangle& t = triangles_[i];
        if (!may_meet(world, probe, t)) return;
        const Vector3d corners[3] = {p.position[t.corners[0]], p.position[t.corners[1]],
                                     p.position[t.corners[2]]};
        const auto w = nearest_weights(place, corners[0], corners[1], corners[2]);
        const Vector3d apart = place - (w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2]);
        const double distance = apart.norm();
        if (!std::isfinite(distance)) return;
        const Vector3d face = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        const double facing =
            distance > 1e-9 ? apart.dot(face) / (distance * std::max(face.norm(), 1e-300)) : 1;
        near_.push_back({i, w, apart, distance, facing});
    });
    keep_nearest(world, probe);
}

bool SurfaceDetector::may_meet(const World& world, const Probe& probe, const Triangle& t) {
    const DeformableSpec& spec = world.deformables[t.deformable].spec;
    const auto meets = [&](std::uint32_t group, std::uint32_t mask) {
        return (group & spec.mask) != 0 && (spec.group & mask) != 0;
    };
    if (probe.deformable == kNoIndex)
        return meets(world.bodies.group[probe.point.body], world.bodies.mask[probe.point.body]);
    const DeformableSpec& other = world.deformables[probe.deformable].spec;
    return meets(other.group, other.mask) &&
           std::find(t.corners.begin(), t.corners.end(), probe.point.particle) == t.corners.end();
}

/// Of each surface the nearest triangle, and the next that the point faces from another side.
void SurfaceDetector::keep_nearest(World& world, const Probe& probe) {
    std::sort(near_.begin(), near_.end(), [&](const Near& x, const Near& y) {
        const std::uint32_t a = triangles_[x.triangle].deformable,
                            b = triangles_[y.triangle].deformable;
        if (a != b) return a < b;
        return x.distance != y.distance ? x.distance < y.distance : x.triangle < y.triangle;
    });
    const auto surface_of = [&](std::size_t i) { return triangles_[near_[i].triangle].deformable; };
    for (std::size_t first = 0, last = 0; first < near_.size(); first = last) {
        while (last < near_.size() && surface_of(last) == surface_of(first)) ++last;
        // of triangles whose common edge or corner is nearest, the one that the point faces most
        // tells inside from outside
        std::size_t best = first;
        const double same = near_[first].distance * (1 + 1e-6) + 1e-12;
        for (std::size_t i = first; i < last && near_[i].distance <= same; ++i)
            if (std::abs(near_[i].facing) > std::abs(near_[best].facing)) best = i;
        if (!add(world, probe, near_[best])) continue;
        const Vector3d direction = near_[best].apart;
        for (std::size_t i = first; i < last; ++i) {
            const Vector3d& other = near_[i].apart;
            if (std::abs(near_[i].facing) < kFaceOn ||
                other.dot(direction) > kSameSide * other.norm() * direction.norm())
                continue;
            add(world, probe, near_[i]);
            break;
        }
    }
}

bool SurfaceDetector::add(World& world, const Probe& probe, const Near& n) {
    const Particles& p = world.particles;
    const Triangle& t = triangles_[n.triangle];
    const bool is_own = probe.deformable == t.deformable;
    const bool is_inside = closed_[t.deformable] && !is_own && n.facing < 0;
    const Vector3d face = (p.position[t.corners[1]] - p.position[t.corners[0]])
                              .cross(p.position[t.corners[2]] - p.position[t.corners[0]]);
    // deep inside nobody can tell where it came from
    if (is_inside && n.distance > std::sqrt(face.norm())) return false;
    Vector3d normal =
        n.distance > 1e-9 ? Vector3d(n.apart / n.distance) : Vector3d(face.normalized());
    if (is_inside) normal = -normal;
    if (!normal.allFinite()) return false;
    double distance = probe.radius + p.radius[t.corners[0]];
    if (is_own) {
        const Deformable& d = world.deformables[t.deformable];
        Vector3d rest = d.spec.points[probe.point.particle - d.first];
        for (int k = 0; k < 3; ++k) rest -= n.weights[k] * d.spec.points[t.corners[k] - d.first];
        distance = std::min(distance, kShareAtRest * rest.norm());
    }
    const std::uint32_t material = probe.point.particle != kNoIndex
                                       ? p.material[probe.point.particle]
                                       : world.bodies.material[probe.point.body];
    const double friction = world.surface_of(material, p.material[t.corners[0]]).friction;
    world.surface_contacts.push_back(
        {probe.point, t.corners, n.weights, normal, distance, friction});
    return true;
}

}  // namespace plumb
