// SPDX-License-Identifier: MIT
#include "contacts/reuse_contacts.h"

#include "contacts/pair_poses.h"
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

/// Share of what is allowed up to which a bound on the motion is as good as the motion: roundings
/// are less than the rest.
constexpr double kSure = 0.99;

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

/// Twice the sine of half the angle by which the smaller body has turned in the other's frame: a
/// point at distance r has moved by r times it.
double turned(const KeptPair& then, const KeptPair& now) {
    return 2 * (then.turn.conjugate() * now.turn).vec().norm();
}

/// How far the smaller body of a pair may move against the other [m], and by how much its rim may
/// turn, while their contacts are kept. Contacts on a rim that turns would lag behind it, and brake
/// what rolls.
struct Allowed {
    double moved, turned;
};

Allowed allowed(const World& world, const KeptPair& pair, ContactsBefore& before) {
    const double distance = world.settings.reuse_distance;
    Allowed most{distance, distance};
    if (!is_round(world, pair.a) && !is_round(world, pair.b)) return most;
    if (has_rim(world, pair.a) || has_rim(world, pair.b)) most.turned = kLag * distance;
    if (before.were_exact(pair)) most.moved = kStill * distance;
    return most;
}

/// Adds what the bodies have moved since the detection before to the bound of a pair.
void add_motion(KeptPair& pair, const Bodies& b, const std::vector<PoseChange>& changes) {
    const PoseChange &of_a = changes[pair.a], &of_b = changes[pair.b];
    const double radius = std::min(b.bounding_radius[pair.a], b.bounding_radius[pair.b]);
    const double reach = pair.offset.norm() + pair.moved + radius;
    pair.moved += of_a.travel + of_b.travel + (of_a.turn + of_b.turn) * reach;
}

/// Whether the contacts of a pair will do at the poses now. Its bound is brought up to date.
bool will_do(KeptPair& pair, const World& world, const Allowed& most) {
    const double surely = kSure * std::min(most.moved, most.turned);
    if (pair.moved <= surely) return true;
    const Bodies& b = world.bodies;
    KeptPair now = pair;
    measure_pose(now, b);
    const double radius = b.bounding_radius[watched(b, pair.a, pair.b).small];
    const double turn = turned(pair, now) * radius;
    pair.moved = (now.offset - pair.offset).norm() + turn;
    return turn <= most.turned && pair.moved <= most.moved;
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
    const std::vector<PoseChange>& changes = *context.changes;
    auto old = kept.pairs_before.begin();
    ContactsBefore before(world.contacts);
    for (std::uint32_t i = 0; i < count; ++i) {
        wanted[i] = 1;
        if (!in_order(pairs, i, sweeps.size())) continue;  // a fault of the collider: nothing kept
        const auto [a, b] = pairs[i];
        const double margin = world.settings.margin + sweeps[a] + sweeps[b];
        while (old != kept.pairs_before.end() && key(*old) < std::tie(a, b)) ++old;
        if (old != kept.pairs_before.end() && key(*old) == std::tie(a, b)) {
            add_motion(*old, world.bodies, changes);
            if (old->margin >= margin - world.settings.reuse_distance &&
                will_do(*old, world, allowed(world, *old, before))) {
                old->fresh = false;
                wanted[i] = 0;
                kept.pairs.push_back(*old);
                continue;
            }
        }
        KeptPair& fresh = kept.pairs.emplace_back();
        fresh.a = a, fresh.b = b, fresh.fresh = true, fresh.margin = margin;
        measure_pose(fresh, world.bodies);
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
            if (pair.count > 0) {
                const PairPoses poses(world.bodies, pair.a, pair.b);
                const auto from = kept.pool.begin() + pair.first;
                const auto at = merged.insert(merged.end(), from, from + pair.count);
                std::for_each(at, merged.end(), [&](Contact& c) { poses.put_into_world(c); });
            }
            kept.reused += pair.count;
            for (; found != table.found.end() && key(*found) == key(pair); ++found) ++unasked;
            continue;
        }
        pair.first = static_cast<std::uint32_t>(kept.pool.size());
        const auto first = found;
        while (found != table.found.end() && key(*found) == key(pair)) ++found;
        pair.count = static_cast<std::uint32_t>(found - first);
        if (pair.count == 0) continue;
        merged.insert(merged.end(), first, found);
        const PairPoses poses(world.bodies, pair.a, pair.b);
        const auto at = kept.pool.insert(kept.pool.end(), first, found);
        std::for_each(at, kept.pool.end(), [&](Contact& c) { poses.put_into_bodies(c); });
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
