// SPDX-License-Identifier: MIT
#include "step/sleeping.h"

#include "constraints/substep_time.h"
#include "contacts/contact_measures.h"
#include "world/sleep.h"
#include "world/tie.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb {
namespace {

/// So often within the time that bodies have to rest it is asked which may sleep.
constexpr double kLooks = 5;

/// No shorter time tells what rests from what begins to move [s].
constexpr double kLeastTime = 0.1;

/// Share of Settings::sleep_speed at which what rests may move on the mean from one look to the
/// next; and share of what gravity gives in a substep that may be left of it.
constexpr double kDrift = 0.1, kPushed = 0.1;

/// Of its fastest point, at the most [m/s].
double speed_of(const Bodies& b, std::size_t i) {
    return b.velocity[i].norm() + b.bounding_radius[i] * b.angular_velocity[i].norm();
}

/// Of the bodies that fell asleep together the first, for all of them.
std::uint32_t first_asleep(const Bodies& b, std::uint32_t body) {
    return b.motion[body] == Motion::asleep ? b.sleeps_with[body] : body;
}

bool touches(const ContactTable& c, const ContactPair& pair) {
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i)
        if (c.memory[i].normal_impulse > 0 || c.found[i].gap <= 0) return true;
    return false;
}

/// Whether a body is kinematic and moves, or may.
bool is_moved_along(const Bodies& b, std::uint32_t body) {
    return body != kNoIndex && b.motion[body] == Motion::kinematic && !is_still(b, body);
}

double least_gap(const ContactTable& c, const ContactPair& pair) {
    double least = c.found[pair.first].gap;
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i)
        least = std::min(least, c.found[i].gap);
    return least;
}

}  // namespace

bool Sleeping::let_sleep(World& world) {
    count_rest(world);
    const Settings& s = world.settings;
    const double look = std::max(s.sleep_time, kLeastTime) / kLooks / s.dt;
    const auto steps = static_cast<std::uint64_t>(std::max(1.0, std::round(look)));
    if (world.steps % steps != 0) return false;
    find_what_stirs(world, static_cast<double>(steps) * s.dt);
    find_pairs(world);
    find_ties(world);
    islands_.find(pairs_, ties_, 0, world.dynamic_count);
    if (!put_to_sleep_what_rests(world)) return false;
    sort_contacts(world);
    return true;
}

/// For how long bodies have rested, and how far they went meanwhile.
void Sleeping::count_rest(World& world) {
    Bodies& b = world.bodies;
    const Settings& s = world.settings;
    const double least_push = kPushed * s.gravity.norm() * substep_of(s);
    asleep_ = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        asleep_ += b.motion[i] == Motion::asleep;
        if (b.motion[i] != Motion::dynamic) continue;
        const bool is_pushed =
            least_push > 0 && (b.velocity[i] - b.velocity_now[i]).norm() > least_push;
        const bool rests = speed_of(b, i) < s.sleep_speed && !is_pushed;
        b.rest_time[i] = rests ? b.rest_time[i] + s.dt : 0;
        b.rest_way[i] += s.dt * b.velocity[i];
        b.rest_turn[i] += s.dt * b.angular_velocity[i];
    }
}

/// `since`: the last look [s].
void Sleeping::find_what_stirs(World& world, double since) {
    Bodies& b = world.bodies;
    stirs_.assign(world.body_of_row.size(), 0);
    const auto stir = [&](std::uint32_t body) {
        if (body != kNoIndex && b.motion[body] == Motion::dynamic) stirs_[b.row[body]] = 1;
    };
    for (std::uint32_t i = 0; i < b.size(); ++i) {
        if (b.motion[i] != Motion::dynamic) continue;
        const double way = b.rest_way[i].norm() + b.bounding_radius[i] * b.rest_turn[i].norm();
        const bool drifts = way > kDrift * world.settings.sleep_speed * since;
        if (drifts || b.rest_time[i] < 0.99 * since) stir(i);
        b.rest_way[i].setZero(), b.rest_turn[i].setZero();
    }
    for (const JointDrive& drive : world.joints.drives) {
        const Joint& joint = world.joints.joints[drive.joint];
        if (drive.kind == DriveKind::motor && !drive.spec.motor.keys.empty() && !joint.broken)
            stir(joint.a), stir(joint.b);
    }
    for (const Joint& joint : world.joints.joints) {
        if (joint.broken) continue;
        if (is_moved_along(b, joint.a)) stir(joint.b);
        if (is_moved_along(b, joint.b)) stir(joint.a);
    }
    world.each_body_among_particles(stir);
    world.each_linked_body(true, stir);
}

void Sleeping::find_pairs(const World& world) {
    const Bodies& b = world.bodies;
    pairs_.clear();
    for (const ContactPair& pair : world.contacts.pairs) {
        if (!touches(world.contacts, pair)) continue;
        for (const auto& [body, other] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)})
            if (b.motion[body] == Motion::dynamic && is_moved_along(b, other))
                stirs_[b.row[body]] = 1;
        pairs_.push_back({world.row_of(pair.a), world.row_of(pair.b), 0, 1});
    }
}

void Sleeping::find_ties(const World& world) {
    ties_.clear();
    const auto tie = [&](TieKind kind, std::uint32_t index) {
        if (!holds(world, {kind, index})) return;
        std::int32_t first = world.zero_row();
        each_body(world, {kind, index}, [&](std::uint32_t body) {
            const std::int32_t row = world.row_of(body);
            if (row >= world.dynamic_count) return;
            ties_.push_back({first < world.dynamic_count ? first : row, row, index, 1});
            first = row;
        });
    };
    for (std::uint32_t i = 0; i < world.joints.size(); ++i) tie(TieKind::joint, i);
    for (std::uint32_t i = 0; i < world.joints.couplings.size(); ++i) tie(TieKind::coupling, i);
}

/// An island rests from when on all of it does.
bool Sleeping::put_to_sleep_what_rests(World& world) {
    Bodies& b = world.bodies;
    const double time = 0.99 * std::max(world.settings.sleep_time, kLeastTime);
    bool any = false;
    const auto consider = [&](auto first, auto last) {
        const bool stirs = std::any_of(first, last, [&](std::int32_t row) { return stirs_[row]; });
        bool rests = !stirs;
        island_.clear();
        for (auto row = first; row != last; ++row) {
            const std::uint32_t body = world.body_of_row[*row];
            if (stirs) b.rest_time[body] = 0;
            rests &= b.rest_time[body] > time;
            island_.push_back(body);
        }
        if (!rests) return;
        put_to_sleep(b, island_);
        asleep_ += static_cast<std::uint32_t>(island_.size());
        any = true;
    };
    const auto rows = islands_.bodies().begin();
    for (const ContactIsland& island : islands_.islands())
        consider(rows + island.first_body, rows + island.last_body);
    for (std::int32_t row = 0; row < world.dynamic_count; ++row)  // what touches nothing
        if (islands_.islands().empty() || islands_.island_of()[row] == ~0u)
            consider(&row, &row + 1);
    return any;
}

bool Sleeping::wake_disturbed(World& world, const std::vector<BodyMotion>& motions) {
    if (asleep_ == 0) return false;
    const std::vector<Motion>& motion = world.bodies.motion;
    const auto sleeps = [&](std::uint32_t body) { return motion[body] == Motion::asleep; };
    bool sorts = false;  // as something wakes, or what sleeps is near what is moved along
    world.each_body_among_particles([&](std::uint32_t body) {
        sorts |= sleeps(body);
        wake(world.bodies, body);
    });
    if (find_blows(world, motions)) {
        spread_blows(world);
        for (std::uint32_t i = 0; i < motion.size(); ++i)
            if (sleeps(i) && is_struck_[i]) sorts = true, wake(world.bodies, i);
    }
    for (const ContactPair& pair : world.contacts.pairs) {
        if (!sleeps(pair.a) && !sleeps(pair.b)) continue;
        sorts |= motion[pair.a] != Motion::dynamic && motion[pair.b] != Motion::dynamic;
        if (!is_disturbed(world, pair, motions)) continue;
        wake(world.bodies, pair.a), wake(world.bodies, pair.b);
        sorts = true;
    }
    if (sorts) sort_contacts(world);
    const auto left =
        static_cast<std::uint32_t>(std::count(motion.begin(), motion.end(), Motion::asleep));
    return std::exchange(asleep_, left) != left;
}

/// Bodies that collide in the step, where one of them is known to; returns whether there are any.
bool Sleeping::find_blows(const World& world, const std::vector<BodyMotion>& motions) {
    const Bodies& b = world.bodies;
    const double slow = std::max(world.settings.sleep_speed, collision_threshold(world.settings));
    is_struck_.assign(b.size(), 0);
    reach_ = 0;
    bool any = false;
    const auto collides = [&](const Contact& c, double reach) {
        const Vector3d u = relative_velocity(b, b.velocity, b.angular_velocity, c, common_point(c));
        return c.gap <= reach && -u.dot(to_eigen(c.normal)) > slow;
    };
    for (const ContactPair& pair : world.contacts.pairs) {
        if (speed_of(b, pair.a) + speed_of(b, pair.b) < slow) continue;
        const double reach =
            motions[pair.a].travel + motions[pair.b].travel + fall_in_step(world.settings);
        const auto first = world.contacts.found.begin() + pair.first;
        if (std::none_of(first, first + pair.count,
                         [&](const Contact& c) { return collides(c, reach); }))
            continue;
        any = true;
        reach_ = std::max(reach_, reach);
        for (const std::uint32_t body : {pair.a, pair.b}) is_struck_[first_asleep(b, body)] = 1;
    }
    return any;
}

/// From what is struck to all that it touches, awake or not.
void Sleeping::spread_blows(const World& world) {
    const Bodies& b = world.bodies;
    bool spreads = true;
    const auto pass_on = [&](const Contact& c) {
        if (c.gap > reach_ || !is_movable(b.motion[c.a]) || !is_movable(b.motion[c.b])) return;
        std::uint8_t &x = is_struck_[first_asleep(b, c.a)], &y = is_struck_[first_asleep(b, c.b)];
        spreads |= x != y;
        x = y = x | y;
    };
    while (spreads) {
        spreads = false;
        for (const auto* found : {&world.contacts.found, &world.asleep.found}) {
            std::for_each(found->begin(), found->end(), pass_on);
            std::for_each(found->rbegin(), found->rend(), pass_on);
        }
    }
    for (std::uint32_t i = 0; i < b.size(); ++i) is_struck_[i] = is_struck_[first_asleep(b, i)];
}

/// A pair of which one sleeps.
bool Sleeping::is_disturbed(const World& world, const ContactPair& pair,
                            const std::vector<BodyMotion>& motions) const {
    if (touches(world.contacts, pair)) return true;
    const Bodies& b = world.bodies;
    const std::uint32_t other = b.motion[pair.a] == Motion::asleep ? pair.b : pair.a;
    const bool rests =
        b.motion[other] == Motion::dynamic && speed_of(b, other) < world.settings.sleep_speed;
    const double reach = motions[other].travel + fall_in_step(world.settings);
    return !rests && least_gap(world.contacts, pair) <= reach;
}

}  // namespace plumb
