// SPDX-License-Identifier: MIT
#include "contacts/reuse_contacts.h"

#include "world/round_shapes.h"

#include <algorithm>
#include <tuple>

namespace plumb {
namespace {

/// Share of the reuse distance by which a rim may turn while its contacts are kept.
constexpr double kLag = 0.01;

/// Share of it by which what is round may move where contacts are solved exactly. Contacts that lag
/// by x behind what rolls over a radius r lead it on by g x/r: what lies in a hollow swings for
/// ever, and what rolls slowly gets faster.
constexpr double kStill = 1e-4;

std::tuple<std::uint32_t, std::uint32_t> key(const KeptPair& p) { return {p.a, p.b}; }
std::tuple<std::uint32_t, std::uint32_t> key(const Contact& c) { return {c.a, c.b}; }

/// Walks along the contacts of the step before, with pairs that rise.
class ContactsBefore {
public:
    explicit ContactsBefore(const ContactTable& contacts) : contacts_(contacts) {}

    /// Whether the pair's contacts were solved exactly.
    bool were_exact(const KeptPair& pair) {
        const std::vector<Contact>& found = contacts_.found_before;
        while (at_ < found.size() && key(found[at_]) < key(pair)) ++at_;
        return at_ < found.size() && key(found[at_]) == key(pair) &&
               contacts_.memory_before[at_].exact;
    }

private:
    const ContactTable& contacts_;
    std::size_t at_ = 0;
};

/// The smaller body of a pair, whose points are watched in the frame of the other.
struct Watched {
    std::uint32_t small, large;
};
Watched watched(const Bodies& b, std::uint32_t i, std::uint32_t j) {
    return b.bounding_radius[i] < b.bounding_radius[j] ? Watched{i, j} : Watched{j, i};
}

void measure_pose(KeptPair& pair, const Bodies& b) {
    const auto [small, large] = watched(b, pair.a, pair.b);
    const Quaterniond back = b.orientation[large].conjugate();
    pair.offset = back * (b.position[small] - b.position[large]);
    pair.turn = back * b.orientation[small];
}

/// Twice the sine of half the angle by which the smaller body has turned in the other's frame.
double turned(const KeptPair& then, const KeptPair& now) {
    return 2 * (then.turn.conjugate() * now.turn).vec().norm();
}

/// Bound on how far any point of the smaller body has moved in the other's frame [m].
double motion(const KeptPair& then, const KeptPair& now, double radius) {
    // A turn by θ moves a point at distance r by the chord 2 r sin(θ/2).
    return (now.offset - then.offset).norm() + turned(then, now) * radius;
}

/// Whether the contacts that `then` has will do at the poses of `now`. Contacts on a rim that turns
/// will not: they would lag behind it, and brake what rolls.
bool will_do(const KeptPair& then, const KeptPair& now, const World& world, bool exact) {
    const Bodies& b = world.bodies;
    const double distance = world.settings.reuse_distance;
    const double radius = b.bounding_radius[watched(b, now.a, now.b).small];
    const double moved = motion(then, now, radius);
    if ((has_rim(world, now.a) || has_rim(world, now.b)) &&
        turned(then, now) * radius > kLag * distance)
        return false;
    if (exact && moved > kStill * distance && (is_round(world, now.a) || is_round(world, now.b)))
        return false;
    return then.margin >= now.margin - distance && moved <= distance;
}

/// Whether candidate i is of bodies that there are, and stands behind the one before it.
bool in_order(const CandidatePair* pairs, std::uint32_t i, std::size_t bodies) {
    const CandidatePair& p = pairs[i];
    if (!(p.a < p.b) || p.b >= bodies) return false;
    return i == 0 || std::tie(pairs[i - 1].a, pairs[i - 1].b) < std::tie(p.a, p.b);
}

void choose(void* ctx, const CandidatePair* pairs, std::uint32_t count, std::uint8_t* wanted) {
    const auto& context = *static_cast<const ReuseContext*>(ctx);
    World& world = *context.world;
    KeptContacts& kept = world.contacts.kept;
    const std::vector<double>& sweeps = *context.sweeps;
    auto old = kept.pairs_before.begin();
    ContactsBefore before(world.contacts);
    for (std::uint32_t i = 0; i < count; ++i) {
        wanted[i] = 1;
        if (!in_order(pairs, i, sweeps.size())) continue;  // a fault of the collider: nothing kept
        KeptPair now{pairs[i].a, pairs[i].b, 0, 0, true, 0, {}, {}};
        now.margin = world.settings.margin + sweeps[now.a] + sweeps[now.b];
        measure_pose(now, world.bodies);
        while (old != kept.pairs_before.end() && key(*old) < key(now)) ++old;
        if (old != kept.pairs_before.end() && key(*old) == key(now) &&
            will_do(*old, now, world, before.were_exact(now))) {
            now = *old;
            now.fresh = false;
        }
        wanted[i] = now.fresh;
        kept.pairs.push_back(now);
    }
}

/// Drops contacts of the pool that no pair has any more, once they are the larger part of it.
void compact(KeptContacts& kept) {
    std::size_t live = 0;
    for (const KeptPair& pair : kept.pairs) live += pair.count;
    if (kept.pool.size() < 2 * live + 256) return;
    std::vector<Contact> pool;
    pool.reserve(kept.pool.capacity());
    for (KeptPair& pair : kept.pairs) {
        const auto from = kept.pool.begin() + pair.first;
        pair.first = static_cast<std::uint32_t>(pool.size());
        pool.insert(pool.end(), from, from + pair.count);
    }
    kept.pool.swap(pool);
}

Contact in_bodies(const Contact& c, const Bodies& b) {
    Contact local = c;
    local.point_a = to_plain(in_body(b, c.a, to_eigen(c.point_a)));
    local.point_b = to_plain(in_body(b, c.b, to_eigen(c.point_b)));
    local.normal = to_plain(Vector3d(b.orientation[c.a].conjugate() * to_eigen(c.normal)));
    return local;
}

/// Appends the contacts of a kept pair, at the poses now.
void append_at_poses(std::vector<Contact>& merged, const KeptContacts& kept, const KeptPair& pair,
                     const Bodies& b) {
    if (pair.count == 0) return;
    const Vector3d at_a = b.position[pair.a], at_b = b.position[pair.b];
    const Matrix3d turn_a = b.orientation[pair.a].toRotationMatrix(),
                   turn_b = b.orientation[pair.b].toRotationMatrix();
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
        Contact& c = merged.emplace_back(kept.pool[i]);
        const Vector3d on_a = at_a + turn_a * to_eigen(c.point_a);
        const Vector3d on_b = at_b + turn_b * to_eigen(c.point_b);
        const Vector3d n = turn_a * to_eigen(c.normal);
        c.point_a = to_plain(on_a), c.point_b = to_plain(on_b), c.normal = to_plain(n);
        c.gap = n.dot(on_a - on_b) - c.radius_a - c.radius_b;
    }
}

}  // namespace

PairFilter reuse_filter(ReuseContext& context) {
    KeptContacts& kept = context.world->contacts.kept;
    kept.pairs_before.swap(kept.pairs);
    kept.pairs.clear();
    return {&context, choose};
}

std::uint32_t merge_kept_contacts(World& world) {
    ContactTable& table = world.contacts;
    KeptContacts& kept = table.kept;
    std::vector<Contact>& merged = table.merged;
    merged.clear();
    auto found = table.found.begin();
    const auto take_found_before = [&](auto bound) {
        while (found != table.found.end() && key(*found) < bound) merged.push_back(*found++);
    };
    kept.reused = 0;
    std::uint32_t unasked = 0;
    for (KeptPair& pair : kept.pairs) {
        take_found_before(key(pair));
        if (!pair.fresh) {
            append_at_poses(merged, kept, pair, world.bodies);
            kept.reused += pair.count;
            for (; found != table.found.end() && key(*found) == key(pair); ++found) ++unasked;
            continue;
        }
        pair.first = static_cast<std::uint32_t>(kept.pool.size());
        for (; found != table.found.end() && key(*found) == key(pair); ++found) {
            kept.pool.push_back(in_bodies(*found, world.bodies));
            merged.push_back(*found);
        }
        pair.count = static_cast<std::uint32_t>(kept.pool.size()) - pair.first;
    }
    merged.insert(merged.end(), found, table.found.end());
    table.found.swap(merged);
    compact(kept);
    return unasked;
}

void forget_kept_contacts(World& world) {
    world.contacts.kept.pairs.clear();
    world.contacts.kept.pool.clear();
}

}  // namespace plumb
