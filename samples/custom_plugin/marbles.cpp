// SPDX-License-Identifier: MIT
/// A plugin of one's own: balls against planes, boxes, capsules and each other, by signed distance.
///
/// Every pair is looked at, so it is for hundreds of bodies and not for thousands.
#include <plumb/plugin.h>

#include "distance.h"

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace marbles {
namespace {

using namespace plumb;

constexpr ShapeKind kKinds[] = {ShapeKind::plane, ShapeKind::sphere, ShapeKind::box,
                                ShapeKind::capsule};

Vec3 turned(const Quat& q, const Vec3& p) {
    const Vec3 u{q.x, q.y, q.z}, twice = 2 * cross(u, p);
    return p + q.w * twice + cross(u, twice);
}
Vec3 turned_back(const Quat& q, const Vec3& p) { return turned({-q.x, -q.y, -q.z, q.w}, p); }

bool is_pose(const Pose& p) {
    const Quat& q = p.rotation;
    const double length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    return std::isfinite(p.position.x + p.position.y + p.position.z) && std::abs(length - 1) < 1e-6;
}

struct Body {
    ShapePlacement placement;
    Pose pose;     ///< of the shape, in the world
    double sweep;  ///< how far it may move this step [m]
    bool present;  ///< it has a finite pose
    bool is_ball() const { return placement.shape.kind == ShapeKind::sphere; }
};

/// A ball against any body; a has the lower id.
Contact contact_of(std::uint32_t id_a, const Body& a, std::uint32_t id_b, const Body& b) {
    const Body &ball = b.is_ball() ? b : a, &other = b.is_ball() ? a : b;
    const Vec3 centre = ball.pose.position, from = other.pose.position;
    const Quat& q = other.pose.rotation;
    const Nearest near = nearest(other.placement.shape, turned_back(q, centre - from));
    const Vec3 anchor = from + turned(q, near.anchor), out = turned(q, near.normal);

    Contact c{};
    c.a = id_a;
    c.b = id_b;
    c.feature = 1;  // a ball touches a shape in one point, which stays the same one
    c.flags = kContactExact;
    const double radius = ball.placement.shape.radius;
    const bool first = &ball == &a;
    c.point_a = first ? centre : anchor;
    c.point_b = first ? anchor : centre;
    c.radius_a = first ? radius : near.radius;
    c.radius_b = first ? near.radius : radius;
    c.normal = first ? out : -1 * out;  // out of b towards a
    c.gap = dot(out, centre - anchor) - radius - near.radius;
    return c;
}

class Marbles final : public Proximity {
public:
    virtual ~Marbles() = default;

    Status add(std::uint32_t id, const ShapePlacement& p) noexcept override {
        if (std::find(std::begin(kKinds), std::end(kKinds), p.shape.kind) == std::end(kKinds))
            return {Status::unsupported, 0, "marbles knows plane, sphere, box and capsule only"};
        if (!sound(p.shape) || !is_pose(p.local) || bodies_.count(id))
            return {Status::bad_argument, 0, "an impossible shape, or an id in use"};
        bodies_[id] = {p, {}, 0, false};
        return ok_status();
    }

    Status remove(std::uint32_t id) noexcept override {
        if (!bodies_.erase(id)) return {Status::bad_argument, 0, "there is no body of this id"};
        std::erase_if(excluded_, [id](const auto& e) { return e.first == id || e.second == id; });
        return ok_status();
    }

    Status exclude(std::uint32_t a, std::uint32_t b, bool excluded) noexcept override {
        const std::pair<std::uint32_t, std::uint32_t> pair = std::minmax(a, b);
        if (excluded)
            excluded_.insert(pair);
        else
            excluded_.erase(pair);
        return ok_status();
    }

    DetectStats stats() const noexcept override { return stats_; }

    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t sink_count) noexcept override {
        if (!request.poses || !sinks || !sink_count || !(request.margin >= 0))
            return {Status::bad_argument, 0, "detect needs poses, a margin and a sink"};
        const std::uint32_t lost = place(request);
        const std::vector<CandidatePair> pairs = candidates();
        std::vector<std::uint8_t> wanted(pairs.size(), 1);
        if (request.filter)
            request.filter->choose(request.filter->ctx, pairs.data(),
                                   static_cast<std::uint32_t>(pairs.size()), wanted.data());
        stats_ = {};
        stats_.broad_pairs = pairs.size();
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            if (!wanted[i]) continue;
            const Body &a = bodies_[pairs[i].a], &b = bodies_[pairs[i].b];
            const Contact c = contact_of(pairs[i].a, a, pairs[i].b, b);
            if (c.gap > request.margin + a.sweep + b.sweep) continue;
            Contact* room = sinks[0].grow(sinks[0].ctx, 1);
            if (!room) return {Status::out_of_memory, 1, "the sink takes no more"};
            *room = c;
            ++stats_.narrow_pairs, ++stats_.from_backend;
        }
        if (lost) return {Status::failed, lost, "bodies without a finite pose were left out"};
        return ok_status();
    }

private:
    /// Puts the shapes where the bodies are; returns how many bodies have no finite pose.
    std::uint32_t place(const DetectRequest& request) {
        std::uint32_t lost = 0;
        for (auto& [id, b] : bodies_) {
            b.present = id < request.body_count && is_pose(request.poses[id]);
            if (!b.present) {
                ++lost;
                continue;
            }
            const Pose &body = request.poses[id], &local = b.placement.local;
            const Quat &p = body.rotation, &q = local.rotation;
            const Vec3 u{p.x, p.y, p.z}, v{q.x, q.y, q.z}, w = p.w * v + q.w * u + cross(u, v);
            b.pose = {body.position + turned(p, local.position),
                      {w.x, w.y, w.z, p.w * q.w - dot(u, v)}};
            b.sweep = request.sweeps ? request.sweeps[id] : 0;
        }
        return lost;
    }

    /// All pairs with a ball that may touch, sorted.
    std::vector<CandidatePair> candidates() const {
        std::vector<CandidatePair> pairs;
        for (auto i = bodies_.begin(); i != bodies_.end(); ++i)
            for (auto j = std::next(i); j != bodies_.end(); ++j) {
                const auto& [id_a, a] = *i;
                const auto& [id_b, b] = *j;
                const ShapePlacement &p = a.placement, &q = b.placement;
                if (!a.present || !b.present || !(a.is_ball() || b.is_ball())) continue;
                if (p.mobility != Mobility::dynamic && q.mobility != Mobility::dynamic) continue;
                if (!(p.group & q.mask) || !(q.group & p.mask)) continue;
                if (!excluded_.count({id_a, id_b})) pairs.push_back({id_a, id_b});
            }
        return pairs;
    }

    std::map<std::uint32_t, Body> bodies_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> excluded_;  ///< the lower id first
    DetectStats stats_{};
};

PluginTable make_table() {
    PluginTable t{};
    t.magic = kPluginMagic;
    t.abi_major = kAbiMajor;
    t.abi_minor = kAbiMinor;
    t.table_size = sizeof(PluginTable);
    t.sizes = abi_sizes();
    t.name = "marbles";
    t.description = "balls against planes, boxes, capsules and each other, by signed distance";
    t.backend_version = "marbles 1";
    t.precision = "double";
    constexpr auto ball = static_cast<std::uint32_t>(ShapeKind::sphere);
    for (ShapeKind kind : kKinds) {
        const auto k = static_cast<std::uint32_t>(kind);
        t.pairs[ball][k] = t.pairs[k][ball] =
            kPairPoint | kPairManifold | kPairSeparated | kPairThreadSafe;
    }
    t.create = [](const CreateRequest*, const char**) -> Proximity* { return new Marbles; };
    t.destroy = [](Proximity* p) { delete static_cast<Marbles*>(p); };
    return t;
}

}  // namespace
}  // namespace marbles

extern "C" PLUMB_PLUGIN_EXPORT const plumb::PluginTable* plumb_collider_plugin() {
    static const plumb::PluginTable table = marbles::make_table();
    return &table;
}
