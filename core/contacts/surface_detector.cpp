// SPDX-License-Identifier: MIT
#include "contacts/surface_detector.h"

#include "constraints/volume.h"
#include "geometry/triangle.h"
#include "math/growing.h"
#include "world/point_place.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

/// Points of one surface keep at most this share of their distance at rest, so that neighbours do
/// not push each other.
constexpr double kShareAtRest = 0.9;
/// Two triangles whose directions differ by more than this cosine both hold a point off.
constexpr double kSameSide = 0.7;
/// Nothing within a cube, or on a face of a bar twice as long as wide, is farther apart than so
/// many times its volume over its surface.
constexpr double kThicknesses = 12;
/// Up to this cosine, rounding, a point lies beside a triangle and not before it.
constexpr double kInPlane = 1e-6;
/// Room for triangles near one point.
constexpr std::size_t kUsuallyNear = 1024;
/// From this cosine on, a point faces a triangle and not only its rim.
constexpr double kFaceOn = Facets::kFacing;
/// Below this cosine nobody can tell on which side of a sharp fold a point is.
constexpr double kEdgeOn = 0.1;

/// Up to what distance two triangles are equally near [m].
double as_near_as(double distance) { return distance * (1 + 1e-6) + 1e-12; }

/// Up to what distance at rest no point is held off a triangle of its own solid that it is behind;
/// 0 of what is not solid, or in pieces [m].
double thickness_of(const Deformable& deformable) {
    const DeformableSpec& spec = deformable.spec;
    if (spec.kind != DeformableKind::solid || !deformable.torn.empty()) return 0;
    double area = 0;
    for (const auto& t : spec.triangles)
        area += (spec.points[t[1]] - spec.points[t[0]])
                    .cross(spec.points[t[2]] - spec.points[t[0]])
                    .norm() /
                2;
    const double volume = volume_of(spec.triangles, [&](std::uint32_t i) -> Vector3d {
        return spec.points[i] - spec.points[0];
    });
    return area > 0 ? kThicknesses * volume / area : 0;
}

}  // namespace

SurfaceDetector::SurfaceDetector(const World& world) {
    for (std::uint32_t i = 0; i < world.deformables.size(); ++i) {
        const Deformable& d = world.deformables[i];
        filters_.push_back({d.spec.group, d.spec.mask});
        closed_.push_back(d.spec.kind == DeformableKind::balloon ||
                          d.spec.kind == DeformableKind::solid);
        thickness_.push_back(thickness_of(d));
        const std::size_t first = triangles_.size();
        for (const auto& t : d.spec.triangles)
            triangles_.push_back({{d.first + t[0], d.first + t[1], d.first + t[2]}, i, {}, {}});
        find_rims(d, first);
    }
    if (!triangles_.empty()) add_probes(world);
    low_.resize(triangles_.size()), high_.resize(triangles_.size());
    faces_.resize(triangles_.size());
    build_tree(world);
}

void SurfaceDetector::build_tree(const World& world) {
    std::vector<Vector3d> middles;
    std::vector<std::uint32_t> groups;
    for (const Triangle& t : triangles_) {
        const Deformable& d = world.deformables[t.deformable];
        Vector3d sum = Vector3d::Zero();
        for (const std::uint32_t corner : t.corners) sum += d.spec.points[corner - d.first];
        middles.push_back(sum / 3), groups.push_back(t.deformable);
    }
    tree_.build(middles, groups);
    facets_.resize(triangles_.size());
}

void SurfaceDetector::find_rims(const Deformable& d, std::size_t first) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const auto& t : d.spec.triangles)
        for (int k = 0; k < 3; ++k) edges.push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
    std::sort(edges.begin(), edges.end());
    std::vector<std::uint8_t> on_rim(d.count, 0);
    for (std::size_t i = 0; i < d.spec.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const auto& t = d.spec.triangles[i];
            const std::array<std::uint32_t, 2> back{t[(k + 2) % 3], t[(k + 1) % 3]};
            if (std::binary_search(edges.begin(), edges.end(), back)) continue;
            triangles_[first + i].rim[k] = true;
            on_rim[back[0]] = on_rim[back[1]] = 1;
        }
    for (std::size_t i = 0; i < d.spec.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k)
            triangles_[first + i].on_rim[k] = on_rim[d.spec.triangles[i][k]] != 0;
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

double SurfaceDetector::speed_of(const World& world, const WorldPoint& p) const {
    if (p.particle != kNoIndex) return speed_[p.particle];
    return world.bodies.velocity[p.body].norm() +
           world.bodies.angular_velocity[p.body].norm() * p.position.norm();
}

/// Every worker looks for its share of the probes, and what they find follows in the probes' order.
void SurfaceDetector::detect(World& world, Workers& workers, double dt) {
    before_.swap(world.surface_contacts);
    world.surface_contacts.clear();
    if (triangles_.empty()) return;
    joined_.find(world);
    follow(world, workers, dt);
    searches_.resize(workers.count());
    searches_[0].found.swap(world.surface_contacts);
    for (Search& search : searches_) {
        const std::size_t own = &search == &searches_[0] ? 1 : workers.count();
        search.found.clear(), search.next_known = 0;
        search.found.reserve(2 * probes_.size() / own + kUsuallyNear);
        search.near.reserve(kUsuallyNear), search.met.reserve(triangles_.size());
        search.candidates.reserve(triangles_.size()), search.closest.resize(closed_.size());
    }
    workers.each(probes_.size(), [&](std::uint32_t i, std::uint32_t worker) {
        look(world, probes_[i], dt, searches_[worker]);
    });
    searches_[0].found.swap(world.surface_contacts);
    for (std::size_t i = 1; i < searches_.size(); ++i)
        append(world.surface_contacts, searches_[i].found);
}

/// Where triangles are, and may come within dt [s].
void SurfaceDetector::follow(const World& world, Workers& workers, double dt) {
    const Particles& p = world.particles;
    speed_.resize(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) speed_[i] = p.velocity[i].norm();
    const Vector3d& origin = p.position[0];
    workers.each(triangles_.size(), [&](std::uint32_t place, std::uint32_t) {
        const std::uint32_t i = tree_.box_at(place);
        const auto& [a, b, c] = triangles_[i].corners;
        const double fastest = std::max({speed_[a], speed_[b], speed_[c]});
        const double grown = p.radius[a] + world.settings.margin + fastest * dt;
        const Vector3d by = Vector3d::Constant(std::isfinite(grown) ? grown : 0);
        const Vector3d low = p.position[a].cwiseMin(p.position[b]).cwiseMin(p.position[c]),
                       high = p.position[a].cwiseMax(p.position[b]).cwiseMax(p.position[c]);
        low_[i] = low - by, high_[i] = high + by;
        Face& face = faces_[i];
        face.normal = (p.position[b] - p.position[a]).cross(p.position[c] - p.position[a]);
        face.size = face.normal.norm();
        tree_.set(place, low_[i], high_[i]);
        facets_.set(place, low - origin, high - origin, p.position[a] - origin,
                    face.normal / std::max(face.size, 1e-300));
    });
    tree_.close();
}

void SurfaceDetector::look(const World& world, const Probe& probe, double dt,
                           Search& search) const {
    find_near(world, probe, dt, search);
    if (search.near.empty()) return;
    if (probe.point.particle == kNoIndex || world.deformables.size() > 1) {
        const Known known = known_of(probe, search.next_known);
        for (Near& n : search.near) find_side(world, probe, known, n, dt);
    }
    keep_nearest(world, probe, search);
}

/// Of the triangles that a probe may meet within dt [s], in their order, those that may be the
/// nearest of their surface, and those that it may face.
void SurfaceDetector::find_near(const World& world, const Probe& probe, double dt,
                                Search& search) const {
    search.near.clear(), search.met.clear();
    const Vector3d at = place_of(world, probe.point);
    const Vector3d slack = Vector3d::Constant(probe.radius + speed_of(world, probe.point) * dt);
    const Place place{at, at - slack, at + slack};
    if (!place.low.allFinite() || !place.high.allFinite()) return;
    find_candidates(world, probe, place, search);
    for (const Candidate& c : search.candidates) {
        const Closest& closest = search.closest[triangles_[c.triangle].deformable];
        if ((c.may_face || !(c.square > closest.limit)) && meets(world, probe, place, c.triangle))
            search.met.push_back(c.triangle);
    }
    std::sort(search.met.begin(), search.met.end());
    for (const std::uint32_t i : search.met) {
        const Near& closest = search.closest[triangles_[i].deformable].near;
        const Near near = closest.triangle == i ? closest : near_point(world, i, at);
        if (std::isfinite(near.distance)) search.near.push_back(near);
    }
}

/// All that their boxes tell may be met, and the closest of each surface.
void SurfaceDetector::find_candidates(const World& world, const Probe& probe, const Place& place,
                                      Search& search) const {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    const Vector3d from_origin = place.at - world.particles.position[0];
    search.candidates.clear();
    for (Closest& closest : search.closest)
        closest.square = closest.limit = kFar, closest.near.triangle = kNoIndex;
    static_assert(Facets::kGroup == BoxTree::kChildren, "a group of facets is a leaf");
    tree_.each_leaf_near(place.low, place.high, [&](std::uint32_t first, std::uint32_t found) {
        const Facets::Sight sight = facets_.look(first / Facets::kGroup, from_origin);
        for (; found != 0; found &= found - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(found));
            const Candidate c{tree_.box_at(first + lane), sight.square[lane],
                              (sight.may_face >> lane & 1) != 0};
            Closest& closest = search.closest[triangles_[c.triangle].deformable];
            if (c.square < closest.square && meets(world, probe, place, c.triangle))
                closest.square = c.square, closest.near.triangle = c.triangle;
            search.candidates.push_back(c);
        }
    });
    for (Closest& closest : search.closest) {
        if (closest.near.triangle == kNoIndex) continue;
        closest.near = near_point(world, closest.near.triangle, place.at);
        const double limit = as_near_as(closest.near.distance) * (1 + 1e-6);
        closest.limit = std::isfinite(limit) ? static_cast<float>(limit * limit) : kFar;
    }
}

/// Of most that are near, the point is a corner.
bool SurfaceDetector::meets(const World& world, const Probe& probe, const Place& place,
                            std::uint32_t i) const {
    return !triangles_[i].has(probe.point.particle) && may_meet(world, probe, triangles_[i]) &&
           !(place.high.array() < low_[i].array()).any() &&
           !(place.low.array() > high_[i].array()).any();
}

SurfaceDetector::Near SurfaceDetector::near_point(const World& world, std::uint32_t triangle,
                                                  const Vector3d& place) const {
    const auto& [i, j, k] = triangles_[triangle].corners;
    const std::vector<Vector3d>& at = world.particles.position;
    Near near;
    near.triangle = triangle;
    near.weights = nearest_weights(place, at[i], at[j], at[k]);
    const auto& w = near.weights;
    near.apart = place - (w[0] * at[i] + w[1] * at[j] + w[2] * at[k]);
    near.distance = near.apart.norm();
    const Face& face = faces_[triangle];
    near.facing = near.distance > 1e-9
                      ? near.apart.dot(face.normal) / (near.distance * std::max(face.size, 1e-300))
                      : 1;
    return near;
}

/// Probes are looked at in the order in which the step before left its contacts.
SurfaceDetector::Known SurfaceDetector::known_of(const Probe& probe, std::uint32_t& next) const {
    const auto owner = [](const WorldPoint& p) {
        return p.particle != kNoIndex ? std::pair(0u, p.particle) : std::pair(1u, p.body);
    };
    const auto size = static_cast<std::uint32_t>(before_.size());
    while (next < size && owner(before_[next].point) < owner(probe.point)) ++next;
    Known known{next, next};
    const auto is_owner = [&](std::uint32_t i) {
        return i < size && owner(before_[i].point) == owner(probe.point);
    };
    const auto is_it = [&](std::uint32_t i) {
        return is_owner(i) && before_[i].point.position == probe.point.position;
    };
    // those before it were of points that are near nothing now
    while (is_owner(known.first) && !is_it(known.first)) ++known.first;
    known.last = known.first;
    while (is_it(known.last)) ++known.last;
    if (known.last > known.first) next = known.first;
    return known;
}

/// Contacts give way by a little at few iterations, and what a sheet's thickness does not stop
/// would be on its other side for good. So a point belongs on the side of the sheet on which it was
/// first seen, for as long as it is seen beside the same part of it, unless it may have come round
/// the rim. Points of the sheet itself do not: folds that have crossed would hold each other fast.
void SurfaceDetector::find_side(const World& world, const Probe& probe, const Known& known, Near& n,
                                double dt) const {
    const Triangle& t = triangles_[n.triangle];
    if (closed_[t.deformable] || probe.deformable == t.deformable) return;
    double most = 0;  // how far the two may have moved along each other
    for (const std::uint32_t corner : t.corners) most = std::max(most, speed_[corner]);
    most = (most + speed_of(world, probe.point)) * dt;
    std::int8_t side = known.first < known.last ? known_side(world, known, n, most) : 0;
    const std::int8_t now = n.facing > kEdgeOn ? 1 : n.facing < -kEdgeOn ? -1 : 0;
    if (side == 0 || is_at_rim(world, n, most)) side = std::abs(n.facing) >= kFaceOn ? now : 0;
    n.side = side;
    n.is_beyond = side != 0 && now == -side;
}

/// That on which the point was beside the nearest part of the sheet, where both may have moved
/// along each other by `most` [m].
std::int8_t SurfaceDetector::known_side(const World& world, const Known& known, const Near& n,
                                        double most) const {
    const Triangle& t = triangles_[n.triangle];
    const Deformable& d = world.deformables[t.deformable];
    const auto at_rest = [&](const auto& corners, const auto& weights) {
        Vector3d sum = Vector3d::Zero();
        for (int k = 0; k < 3; ++k) sum += weights[k] * d.spec.points[corners[k] - d.first];
        return sum;
    };
    const Vector3d here = at_rest(t.corners, n.weights);
    double nearest =
        most +
        (d.spec.points[t.corners[1] - d.first] - d.spec.points[t.corners[0] - d.first]).norm();
    std::int8_t side = 0;
    for (std::uint32_t i = known.first; i < known.last; ++i) {
        const SurfaceContact& c = before_[i];
        if (c.side == 0 || c.triangle[0] < d.first || c.triangle[0] >= d.first + d.count) continue;
        const double way = (at_rest(c.triangle, c.weights) - here).norm();
        if (way < nearest) nearest = way, side = c.side;
    }
    return side;
}

/// Whether what is near may have come round the rim, where both may have moved along each other by
/// `most` [m].
bool SurfaceDetector::is_at_rim(const World& world, const Near& n, double most) const {
    const Triangle& t = triangles_[n.triangle];
    const std::vector<Vector3d>& at = world.particles.position;
    for (int k = 0; k < 3; ++k) {
        if (t.on_rim[k] && n.weights[k] == 1) return true;
        if (!t.rim[k]) continue;
        const Vector3d &a = at[t.corners[(k + 1) % 3]], &b = at[t.corners[(k + 2) % 3]],
                       &c = at[t.corners[k]];
        const Vector3d edge = b - a;
        const double height = edge.cross(c - a).norm() / std::max(edge.norm(), 1e-300);
        if (n.weights[k] * height <= most) return true;
    }
    return false;
}

/// What lies behind a triangle of its own solid at rest is held off by the elements between.
/// Contacts would hold parts of a crushed solid fast that have gone through each other. The same
/// goes for what is beside the triangle; farther away, a face may be folded onto itself.
bool SurfaceDetector::is_behind(const World& world, const Probe& probe, const Triangle& t) const {
    const double thickness = thickness_[t.deformable];
    if (probe.deformable != t.deformable || thickness == 0) return false;
    const Deformable& d = world.deformables[t.deformable];
    const auto at_rest = [&](std::uint32_t i) -> const Vector3d& {
        return d.spec.points[i - d.first];
    };
    const Vector3d &a = at_rest(t.corners[0]), &b = at_rest(t.corners[1]),
                   &c = at_rest(t.corners[2]);
    const Vector3d normal = (b - a).cross(c - a),
                   apart = at_rest(probe.point.particle) - (a + b + c) / 3;
    const double distance = apart.norm();
    return distance < thickness && apart.dot(normal) <= kInPlane * distance * normal.norm();
}

bool SurfaceDetector::may_meet(const World& world, const Probe& probe, const Triangle& t) const {
    if (is_behind(world, probe, t)) return false;
    if (probe.point.body != kNoIndex)
        for (const std::uint32_t corner : t.corners)
            if (joined_.has(corner, probe.point.body)) return false;
    const Filter& surface = filters_[t.deformable];
    const Filter other = probe.deformable != kNoIndex ? filters_[probe.deformable]
                                                      : Filter{world.bodies.group[probe.point.body],
                                                               world.bodies.mask[probe.point.body]};
    return (other.group & surface.mask) != 0 && (surface.group & other.mask) != 0;
}

/// Of each surface the nearest triangle, and the next that the point faces from another side.
void SurfaceDetector::keep_nearest(const World& world, const Probe& probe, Search& search) const {
    const std::vector<Near>& near = search.near;
    const auto keep = [&](const Near& n) { return add(world, probe, n, search.found); };
    const auto surface_of = [&](const Near& n) { return triangles_[n.triangle].deformable; };
    const auto is_nearer = [](const Near& x, const Near& y) {
        return x.distance != y.distance ? x.distance < y.distance : x.triangle < y.triangle;
    };
    for (auto first = near.begin(), last = first; first != near.end(); first = last) {
        last = std::find_if(first, near.end(),
                            [&](const Near& n) { return surface_of(n) != surface_of(*first); });
        // of triangles whose common edge or corner is nearest, the one that the point faces most
        // tells inside from outside
        const Near& nearest = *std::min_element(first, last, is_nearer);
        const Near* best = &nearest;
        const double same = as_near_as(nearest.distance);
        for (auto n = first; n != last; ++n) {
            if (n->distance > same) continue;
            const double more = std::abs(n->facing) - std::abs(best->facing);
            if (more > 0 || (more == 0 && is_nearer(*n, *best))) best = &*n;
        }
        if (!keep(*best)) continue;
        const auto out_of = [](const Near& n) {
            return n.is_beyond ? Vector3d(-n.apart) : n.apart;
        };
        const Vector3d direction = out_of(*best);
        if (probe.point.body != kNoIndex && probe.radius > 0 && !closed_[surface_of(nearest)]) {
            // what is round lies on all of a sheet that it faces
            for (auto n = first; n != last; ++n)
                if (&*n != best && std::abs(n->facing) >= kFaceOn) keep(*n);
            continue;
        }
        const Near* other = nullptr;
        for (auto n = first; n != last; ++n) {
            if (std::abs(n->facing) < kFaceOn || (other && is_nearer(*other, *n))) continue;
            const Vector3d out = out_of(*n);
            if (!(out.dot(direction) > kSameSide * out.norm() * direction.norm())) other = &*n;
        }
        if (other) keep(*other);
    }
}

bool SurfaceDetector::add(const World& world, const Probe& probe, const Near& n,
                          std::vector<SurfaceContact>& found) const {
    const Particles& p = world.particles;
    const Triangle& t = triangles_[n.triangle];
    const bool is_own = probe.deformable == t.deformable;
    const bool is_inside = n.is_beyond || (closed_[t.deformable] && !is_own && n.facing < 0);
    const Face& face = faces_[n.triangle];
    // deep inside nobody can tell where it came from
    if (is_inside && n.distance > std::sqrt(face.size)) return false;
    Vector3d normal =
        n.distance > 1e-9 ? Vector3d(n.apart / n.distance) : Vector3d(face.normal.normalized());
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
    found.push_back({probe.point, t.corners, n.weights, normal, distance, friction, n.side});
    return true;
}

}  // namespace plumb
