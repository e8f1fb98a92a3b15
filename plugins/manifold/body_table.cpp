// SPDX-License-Identifier: MIT
#include "manifold/body_table.h"

#include "manifold/check_shape.h"

namespace plumb {
namespace {

std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

bool all_supported(const Shape& shape, const bool (&supported)[kShapeKindCount]) {
    if (static_cast<std::uint32_t>(shape.kind) >= kShapeKindCount) return false;
    if (!supported[static_cast<std::uint32_t>(shape.kind)]) return false;
    if (shape.kind != ShapeKind::compound) return true;
    for (std::uint32_t i = 0; i < shape.part_count; ++i)
        if (!all_supported(shape.parts[i].shape, supported)) return false;
    return true;
}

Aabb bounds_of_vertices(const Shape& shape) {
    Aabb box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
    for (std::uint32_t i = 0; i < shape.vertex_count; ++i)
        for (int k = 0; k < 3; ++k) {
            at(box.low, k) = std::min(at(box.low, k), at(shape.vertices[i], k));
            at(box.high, k) = std::max(at(box.high, k), at(shape.vertices[i], k));
        }
    return box;
}

/// Half the extent of a box of half extents `h`, turned, along each world axis.
Vec3 turned_extents(const Frame& f, Vec3 h) {
    Vec3 e{};
    for (int k = 0; k < 3; ++k)
        at(e, k) = std::abs(at(f.axis[0], k)) * h.x + std::abs(at(f.axis[1], k)) * h.y +
                   std::abs(at(f.axis[2], k)) * h.z;
    return e;
}

/// Half the extent of a disc with the given axis.
Vec3 disc_extents(Vec3 axis, double radius) {
    const auto side = [&](double c) { return radius * std::sqrt(std::max(0.0, 1 - c * c)); };
    return {side(axis.x), side(axis.y), side(axis.z)};
}

Vec3 absolute(Vec3 v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

/// A half-space is bounded along an axis only where its normal is that axis.
Aabb bounds_of_plane(const Frame& f) {
    Aabb box{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
    for (int k = 0; k < 3; ++k) {
        if (at(f.axis[1], k) > 1 - 1e-14) at(box.high, k) = at(f.origin, k);
        if (at(f.axis[1], k) < -1 + 1e-14) at(box.low, k) = at(f.origin, k);
    }
    return box;
}

/// A height field goes on without end below its surface.
Aabb bounds_of_solid(Aabb surface, const Frame& f) {
    for (int k = 0; k < 3; ++k) {
        if (at(f.axis[1], k) > 1e-14) at(surface.low, k) = -kInfinity;
        if (at(f.axis[1], k) < -1e-14) at(surface.high, k) = kInfinity;
    }
    return surface;
}

double half_width_of_hull(const Part& hull) {
    double least = kInfinity;
    for (const HullFace& face : hull.faces) {
        double low = kInfinity;
        for (std::uint32_t i = 0; i < hull.shape.vertex_count; ++i)
            low = std::min(low, dot(face.normal, hull.shape.vertices[i]));
        least = std::min(least, dot(face.normal, hull.shape.vertices[face.corners[0]]) - low);
    }
    return std::isfinite(least) ? 0.5 * least : 0;
}

/// Half the least distance of two parallel planes that hold a convex shape; of a cone the radius of
/// the ball inside.
double half_width_of(const Part& part) {
    const Shape& s = part.shape;
    switch (s.kind) {
        case ShapeKind::sphere:
        case ShapeKind::capsule:
            return s.radius;
        case ShapeKind::box:
            return std::min({s.half_extents.x, s.half_extents.y, s.half_extents.z});
        case ShapeKind::cylinder:
            return std::min(s.radius, s.half_height);
        case ShapeKind::cone:
            return 2 * s.radius * s.half_height /
                   (s.radius + std::hypot(s.radius, 2 * s.half_height));
        case ShapeKind::hull:
            return half_width_of_hull(part);
        default:
            return 0;
    }
}

bool placed(const Frame& f) { return finite(f.axis[0]) && finite(f.axis[1]) && finite(f.origin); }

}  // namespace

Aabb bounds_at(const Part& part, const Frame& f) {
    const Shape& s = part.shape;
    Vec3 centre = f.origin, half{};
    switch (s.kind) {
        case ShapeKind::plane:
            return bounds_of_plane(f);
        case ShapeKind::sphere:
            half = {s.radius, s.radius, s.radius};
            break;
        case ShapeKind::box:
            half = turned_extents(f, s.half_extents);
            break;
        case ShapeKind::capsule:
            half = s.half_height * absolute(f.axis[1]) + Vec3{s.radius, s.radius, s.radius};
            break;
        case ShapeKind::cylinder:
        case ShapeKind::cone:
            half = s.half_height * absolute(f.axis[1]) + disc_extents(f.axis[1], s.radius);
            break;
        default:
            centre = to_outer(f, 0.5 * (part.own_bounds.low + part.own_bounds.high));
            half = turned_extents(f, 0.5 * (part.own_bounds.high - part.own_bounds.low));
    }
    const Aabb box{centre - half, centre + half};
    return s.kind == ShapeKind::height_field ? bounds_of_solid(box, f) : box;
}

BodyTable::Range BodyTable::parts_of(std::uint32_t body) const {
    const Range places = places_of(body);
    const bool is_here = places.first < places.last && !parts_[places.first].vacant;
    return {places.first, is_here ? places.last : places.first};
}

/// With those that are vacant.
BodyTable::Range BodyTable::places_of(std::uint32_t body) const {
    const auto first =
        std::lower_bound(parts_.begin(), parts_.end(), body,
                         [](const Part& p, std::uint32_t id) { return p.body < id; });
    const auto last =
        std::find_if(first, parts_.end(), [body](const Part& p) { return p.body != body; });
    return {static_cast<std::uint32_t>(first - parts_.begin()),
            static_cast<std::uint32_t>(last - parts_.begin())};
}

bool BodyTable::knows(std::uint32_t body) const {
    const Range range = parts_of(body);
    return range.first < range.last;
}

Status BodyTable::add(std::uint32_t body, const ShapePlacement& placement,
                      const bool (&supported)[kShapeKindCount], const char* refusal) {
    if (body == kNoBody) return {Status::bad_argument, 0, "this body id is reserved"};
    if (knows(body)) return {Status::bad_argument, 0, "this body id is in use"};
    if (const char* flaw = flaw_of(placement.shape)) return {Status::bad_argument, 0, flaw};
    if (!all_supported(placement.shape, supported)) return {Status::unsupported, 0, refusal};
    if (!placed(frame_of(placement.local)))
        return {Status::bad_argument, 0, "the shape's place in its body is not finite"};
    insert(body, placement);
    return ok_status();
}

void BodyTable::insert(std::uint32_t body, const ShapePlacement& placement) {
    const Shape& shape = placement.shape;
    const bool compound = shape.kind == ShapeKind::compound;
    std::vector<Part> fresh(compound ? shape.part_count : 1);
    for (std::uint32_t i = 0; i < fresh.size(); ++i) {
        Part& part = fresh[i];
        part.body = body;
        part.index = i;
        part.in_compound = compound;
        part.shape = compound ? shape.parts[i].shape : shape;
        part.local = frame_of(placement.local);
        if (compound) part.local = part.local * frame_of(shape.parts[i].local);
        if (part.shape.kind == ShapeKind::hull) part.faces = merged_faces(part.shape);
        if (part.shape.vertex_count) part.own_bounds = bounds_of_vertices(part.shape);
        if (has_surface(part.shape.kind)) {
            part.surface = surfaces_.of(part.shape);
            if (!part.surface->tree().empty()) part.own_bounds = part.surface->tree().bounds();
        }
        part.half_width = half_width_of(part);
        part.group = placement.group;
        part.mask = placement.mask;
        part.dynamic = placement.mobility == Mobility::dynamic;
        part.has_exclusions = exclusions_.contains(body);
    }
    const Range places = places_of(body);
    const auto first = parts_.begin() + places.first, last = parts_.begin() + places.last;
    const std::size_t left = places.last - places.first;
    if (left == fresh.size()) {
        std::move(fresh.begin(), fresh.end(), first);
    } else {
        if (places.last < parts_.size()) ++order_;
        parts_.insert(parts_.erase(first, last), std::make_move_iterator(fresh.begin()),
                      std::make_move_iterator(fresh.end()));
    }
    vacant_ -= left;
    ++version_;
}

Status BodyTable::remove(std::uint32_t body) {
    if (!knows(body)) return {Status::bad_argument, 0, "there is no body of this id"};
    vacate(parts_of(body));
    end_exclusions(body);
    ++version_;
    return ok_status();
}

/// Vacant places at the end fall away, and all where they are more than the others.
void BodyTable::vacate(Range places) {
    for (std::uint32_t i = places.first; i < places.last; ++i) {
        const std::uint32_t body = parts_[i].body;
        parts_[i] = Part{};
        parts_[i].body = body, parts_[i].vacant = true;
        ++vacant_;
    }
    for (; !parts_.empty() && parts_.back().vacant; --vacant_) parts_.pop_back();
    if (2 * vacant_ <= parts_.size()) return;
    std::erase_if(parts_, [](const Part& part) { return part.vacant; });
    vacant_ = 0;
    ++order_;
}

void BodyTable::end_exclusions(std::uint32_t body) {
    if (!exclusions_.contains(body)) return;
    std::erase_if(excluded_, [&](std::uint64_t key) {
        const auto a = static_cast<std::uint32_t>(key >> 32), b = static_cast<std::uint32_t>(key);
        if (a != body && b != body) return false;
        count_exclusion(a, -1), count_exclusion(b, -1);
        return true;
    });
}

Status BodyTable::exclude(std::uint32_t a, std::uint32_t b, bool excluded) {
    if (a == b) return {Status::bad_argument, 0, "a body cannot be excluded from itself"};
    const std::uint64_t key = pair_key(a, b);
    if (!(excluded ? excluded_.insert(key).second : excluded_.erase(key) > 0)) return ok_status();
    count_exclusion(a, excluded ? 1 : -1), count_exclusion(b, excluded ? 1 : -1);
    const Range of_one = parts_of(a);
    for (std::uint32_t i = of_one.first; i < of_one.last; ++i) parts_[i].fat = kNothing;
    return ok_status();
}

void BodyTable::count_exclusion(std::uint32_t body, int change) {
    const auto count = exclusions_.try_emplace(body, 0).first;
    count->second += change;
    const bool any = count->second > 0;
    if (!any) exclusions_.erase(count);
    const Range range = parts_of(body);
    for (std::uint32_t i = range.first; i < range.last; ++i) parts_[i].has_exclusions = any;
}

Status BodyTable::place(const DetectRequest& request) {
    if (!(request.margin >= 0) || (request.body_count && !request.poses))
        return {Status::bad_argument, 0, "detect needs poses and a margin of at least 0"};
    std::uint32_t lost = 0;
    greatest_expansion_ = 0;
    for (Part& part : parts_) {
        if (part.vacant) continue;
        part.present = part.body < request.body_count;
        if (part.present) part.world = frame_of(request.poses[part.body]) * part.local;
        part.present = part.present && placed(part.world);
        lost += !part.present;
        if (!part.present) continue;

        // Grown by half the margin and the whole sweep, two boxes overlap wherever their parts may
        // be near.
        const double sweep = request.sweeps ? request.sweeps[part.body] : 0.0;
        part.expansion = 0.5 * request.margin + (sweep > 0 ? sweep : 0.0);
        greatest_expansion_ = std::max(greatest_expansion_, part.expansion);
        const Vec3 grown{part.expansion, part.expansion, part.expansion};
        part.bounds = bounds_of(part);
        part.bounds = {part.bounds.low - grown, part.bounds.high + grown};
    }
    if (lost) return {Status::failed, lost, "shapes without a finite pose were left out"};
    return ok_status();
}

bool BodyTable::wanted(const Part& a, const Part& b) const {
    if (a.body == b.body || (!a.dynamic && !b.dynamic)) return false;
    if (!(a.group & b.mask) || !(b.group & a.mask)) return false;
    if (!a.has_exclusions || !b.has_exclusions) return true;
    return excluded_.count(pair_key(a.body, b.body)) == 0;
}

void sort_pairs(std::vector<PartPair>& pairs, const std::vector<Part>& parts) {
    // First by counting, into one heap for each first body; the heaps are small. Parts stand in the
    // order of their bodies, so a body's parts share the heap of its first part.
    std::vector<std::uint32_t> heap(parts.size()), begin(parts.size() + 1, 0);
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        heap[i] = i > 0 && parts[i].body == parts[i - 1].body ? heap[i - 1] : i;
    for (const PartPair& pair : pairs) ++begin[heap[pair.first] + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    std::vector<PartPair> sorted(pairs.size());
    std::vector<std::uint32_t> end(begin.begin(), begin.end() - 1);
    for (const PartPair& pair : pairs) sorted[end[heap[pair.first]]++] = pair;

    // Only compounds make bodies and parts disagree about the order.
    const auto before = [&](const PartPair& p, const PartPair& q) {
        return std::tuple(parts[p.second].body, p.first, p.second) <
               std::tuple(parts[q.second].body, q.first, q.second);
    };
    for (std::size_t i = 0; i + 1 < begin.size(); ++i)
        std::sort(sorted.begin() + begin[i], sorted.begin() + begin[i + 1], before);
    pairs.swap(sorted);
}

}  // namespace plumb
