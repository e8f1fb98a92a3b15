// SPDX-License-Identifier: MIT
#include "world/sleep.h"

#include <algorithm>

namespace plumb {
namespace {

/// A place in one of two columns that become one.
struct Source {
    bool second;
    std::uint32_t index;
};
using Order = std::vector<Source>;

/// What becomes of the contacts of a pair: those between what sleeps and what is moved along are
/// of one step alone.
enum class Fate { among_those_of_the_step, aside, gone };

Fate fate_of(const Bodies& b, std::uint32_t x, std::uint32_t y) {
    if (b.motion[x] == Motion::dynamic || b.motion[y] == Motion::dynamic)
        return Fate::among_those_of_the_step;
    return is_still(b, x) && is_still(b, y) ? Fate::aside : Fate::gone;
}

/// Sorts the rows of two lists, each sorted by its bodies, by what becomes of them. Where both have
/// a pair, that of `now` counts.
template <class Row>
void sort_rows(const std::vector<Row>& now, const std::vector<Row>& aside, const Bodies& bodies,
               Order& stays, Order& leaves) {
    stays.clear(), leaves.clear();
    const auto key = [](const Row& row) { return pair_key(row.a, row.b); };
    const auto take = [&](const std::vector<Row>& from, bool second, std::size_t i) {
        const Fate fate = fate_of(bodies, from[i].a, from[i].b);
        if (fate == Fate::gone) return;
        (fate == Fate::aside ? leaves : stays).push_back({second, static_cast<std::uint32_t>(i)});
    };
    for (std::size_t i = 0, k = 0; i < now.size() || k < aside.size();) {
        const bool later = i == now.size();
        if (!later && k < aside.size() && key(aside[k]) == key(now[i])) {
            const std::uint64_t both = key(now[i]);
            while (k < aside.size() && key(aside[k]) == both) ++k;
            while (i < now.size() && key(now[i]) == both) take(now, false, i++);
        } else if (later || (k < aside.size() && key(aside[k]) < key(now[i]))) {
            take(aside, true, k++);
        } else {
            take(now, false, i++);
        }
    }
}

template <class Row>
std::vector<Row> column_of(const std::vector<Row>& first, const std::vector<Row>& second,
                           const Order& order) {
    std::vector<Row> column;
    column.reserve(order.size());
    for (const Source& s : order) column.push_back((s.second ? second : first)[s.index]);
    return column;
}

template <class Row>
void split(std::vector<Row>& now, std::vector<Row>& aside, const Order& stays,
           const Order& leaves) {
    std::vector<Row> left = column_of(now, aside, leaves);
    now = column_of(now, aside, stays);
    aside = std::move(left);
}

/// Where contacts that were detected in this step are now. `count`: of the contacts before.
void renew_comes(std::vector<ContactMove>& comes, std::size_t count, const Order& stays) {
    std::vector<std::uint32_t> from(count, kNoIndex);
    for (const ContactMove& m : comes)
        for (std::uint32_t i = 0; i < m.count && m.to + i < count; ++i) from[m.to + i] = m.from + i;
    comes.clear();
    for (std::uint32_t to = 0; to < stays.size(); ++to)
        if (!stays[to].second && from[stays[to].index] != kNoIndex)
            comes.push_back({from[stays[to].index], to, 1});
}

void stop(Bodies& b, std::size_t i) {
    for (auto* column :
         {&b.velocity, &b.angular_velocity, &b.velocity_now, &b.angular_velocity_now,
          &b.velocity_before, &b.angular_velocity_before, &b.angular_momentum, &b.turn_change})
        (*column)[i].setZero();
}

/// Whether two bodies could touch.
bool are_near(const World& world, std::uint32_t a, std::uint32_t b) {
    return !spheres_are_apart(world.bodies, a, b, 2 * world.settings.margin);
}

}  // namespace

bool is_still(const Bodies& b, std::size_t i) {
    if (b.motion[i] != Motion::kinematic) return b.motion[i] != Motion::dynamic;
    return b.script[i].keyframes.empty() && b.velocity[i].isZero(0) &&
           b.angular_velocity[i].isZero(0);
}

void set_asleep(Bodies& b, std::size_t i, bool asleep) {
    b.motion[i] = asleep ? Motion::asleep : Motion::dynamic;
    b.inverse_mass[i] = asleep ? 0 : 1 / b.mass[i];
    b.inverse_inertia[i] =
        asleep ? Vector3d(Vector3d::Zero()) : Vector3d(b.inertia[i].cwiseInverse());
    if (asleep) b.world_inverse_inertia[i] = {};
}

void put_to_sleep(Bodies& b, const std::vector<std::uint32_t>& island) {
    const std::uint32_t first = *std::min_element(island.begin(), island.end());
    for (const std::uint32_t i : island) {
        b.sleeps_with[i] = first;
        stop(b, i);
        set_asleep(b, i, true);
    }
}

void wake(Bodies& b, std::uint32_t body) {
    if (b.motion[body] != Motion::asleep) return;
    const std::uint32_t first = b.sleeps_with[body];
    for (std::uint32_t i = 0; i < b.size(); ++i)
        if (b.sleeps_with[i] == first) {
            b.sleeps_with[i] = kNoIndex, b.rest_time[i] = 0;
            set_asleep(b, i, false);
        }
}

bool wake_near(World& world, std::uint32_t body) {
    Bodies& b = world.bodies;
    bool any = false;
    const auto stir = [&](std::uint32_t i) {
        if (i == kNoIndex) return;
        any |= b.motion[i] == Motion::asleep;
        wake(b, i);
        b.rest_time[i] = 0;
    };
    const auto may_rest = [&](std::uint32_t i) {
        return b.motion[i] == Motion::asleep || (is_movable(b.motion[i]) && b.rest_time[i] > 0);
    };
    for (std::uint32_t i = 0; i < b.size(); ++i)
        if (may_rest(i) && are_near(world, i, body)) stir(i);
    for (const Joint& joint : world.joints.joints)
        if (joint.a == body || joint.b == body) stir(joint.a), stir(joint.b);
    if (any) sort_contacts(world);
    return any;
}

void sort_contacts(World& world) {
    ContactTable& table = world.contacts;
    KeptContacts& kept = table.kept;
    SleepingContacts& aside = world.asleep;
    Order stays, leaves;
    sort_rows(table.found, aside.found, world.bodies, stays, leaves);
    const bool rides =
        kept.rides.size() == table.found.size() && aside.rides.size() == aside.found.size();
    renew_comes(kept.comes, table.found.size(), stays);
    split(table.found, aside.found, stays, leaves);
    split(table.memory, aside.memory, stays, leaves);
    if (rides) {
        split(kept.rides, aside.rides, stays, leaves);
        sort_rows(kept.pairs, aside.pairs, world.bodies, stays, leaves);
        split(kept.poses, aside.poses, stays, leaves);
        split(kept.pairs, aside.pairs, stays, leaves);
    } else {  // all are detected anew
        kept.rides.clear(), kept.pairs.clear(), kept.poses.clear();
        aside.rides.clear(), aside.pairs.clear(), aside.poses.clear();
    }
    table.list_pairs();
}

}  // namespace plumb
