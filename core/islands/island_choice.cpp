// SPDX-License-Identifier: MIT
#include "islands/island_choice.h"

#include "constraints/contact.h"
#include "constraints/substep_time.h"
#include "contacts/contact_measures.h"
#include "islands/island_account.h"
#include "islands/island_effort.h"
#include "islands/large_islands.h"
#include "schedule/joint_trees.h"
#include "ties/joint_state.h"
#include "ties/tie_work.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// An island is calm where its contacts slide, part and approach by less than this times √(g r), r
/// the radius of its largest body, in the root of the mean square: about the speed of what fell by
/// r/32. One body that drops on a heap does not take all others out of their rest.
constexpr double kCalm = 0.25;

/// Overlaps deeper than this share of the radius of a body are pushed out by sweeps: where normals
/// contradict each other there is nothing to be exact about.
constexpr double kDeep = 0.02;

/// Where an island is driven, so are those beyond this share of which an exact solution pushed out
/// less than this part of what it was asked to: friction that holds as hard as the push-out pushes
/// locks a wedge, and sweeps let it slip. A heap that is left to itself comes to rest around its
/// wedges, and sweeps would stir it for ever.
constexpr double kJam = 0.0025, kStuck = 0.25;

/// What rests has been pulled on for a substep already; what is hardly faster counts as resting.
constexpr double kPulledOn = 1.05;

/// kCalm of a body, with what a pull [m/s²] makes of rest in a substep or two [m/s].
double calm_speed(const World& world, double radius, double pull) {
    return kCalm * std::sqrt(pull * radius) + 2 * pull * substep_of(world.settings);
}

/// Share of an overlap that counts as left as it was after a step.
double stuck_share(const Settings& s) {
    const double left = 1 - push_out_share(s.stiffness, substep_of(s));
    return 1 - kStuck * (1 - std::pow(left, s.substeps));
}

}  // namespace

const ContactIslands& IslandChoice::find(const World& world, const std::vector<BodyPair>& pairs,
                                         const SolvedTies& solved) {
    stuck_share_ = stuck_share(world.settings);
    jammed_.clear();
    if (!pairs.empty() || has_seeds_) ties_.find(world);
    // ties only break
    has_seeds_ = ties_.has_seeds();
    const bool is_empty = pairs.empty() && !has_seeds_;
    found_.find(pairs, ties_.rows(), ties_.first_seed(), is_empty ? 0 : world.dynamic_count);
    driven_.find(world, pairs, ties_.all(), found_);
    if (is_empty) return found_;
    obstacles_.find(world, ties_.all(), solved);
    bears_.assign(static_cast<std::size_t>(world.dynamic_count), 0);
    return found_;
}

bool IslandChoice::can_do_work(const World& world, const ContactIsland& island) const {
    const auto first = found_.ties().begin();
    return std::any_of(first + island.first_tie, first + island.last_tie,
                       [&](std::uint32_t i) { return plumb::can_do_work(world, ties_[i]); });
}

bool IslandChoice::is_meshed(const ContactIsland& island) const {
    const auto ties = found_.ties().begin();
    const auto first = ties + island.first_tie, last = ties + island.last_tie;
    const auto mesh = std::lower_bound(first, last, ties_.first_seed());
    if (mesh == last) return false;
    const bool touches = island.first_pair < island.last_pair;
    const bool loops = std::any_of(
        mesh, last, [&](std::uint32_t i) { return ties_[i].kind != TieKind::coupling; });
    return !touches || loops || is_mostly_coupled(last - mesh, mesh - first);
}

/// Whether a joint is farther open than the radius of what it holds.
bool IslandChoice::is_torn(const World& world, const ContactIsland& island) const {
    const Bodies& b = world.bodies;
    const auto radius = [&](std::uint32_t body) {
        return body != kNoIndex && b.motion[body] == Motion::dynamic ? b.bounding_radius[body] : 0;
    };
    const auto is_open = [&](std::uint32_t i) {
        if (ties_[i].kind != TieKind::joint) return false;
        const Joint& joint = world.joints.joints[ties_[i].index];
        if (!joint.locked[kAlongX] || !joint.locked[kAlongY] || !joint.locked[kAlongZ] ||
            joint.length > 0 || joint.compliance > 0)
            return false;
        const JointPose pose = joint_pose(b, joint);
        return (pose.point_a - pose.point_b).norm() > std::max(radius(joint.a), radius(joint.b));
    };
    const auto first = found_.ties().begin();
    return std::any_of(first + island.first_tie, first + island.last_tie, is_open);
}

bool IslandChoice::is_loose(const ContactIsland& island) const {
    return island.first_tie == island.last_tie && !is_driven(island);
}

bool IslandChoice::is_loose_heap(const ContactIsland& island) const {
    return island.last_body - island.first_body > kVerySmall && is_loose(island);
}

IslandWay IslandChoice::way_of(const World& world, const ContactIsland& island,
                               const std::vector<BodyPair>& pairs) {
    const std::uint32_t n = island.last_body - island.first_body;
    const bool is_tied = island.first_tie < island.last_tie;
    if (n == 1 && !is_tied &&
        !is_slow(world, world.contacts.found[pairs[found_.pairs()[island.first_pair]].first]))
        return IslandWay::left;
    const bool meshed = is_meshed(island);
    std::uint8_t obstacles = obstacles_.of(found_, island);
    // what hangs at rest has known loads, with which its levers turn
    if (!meshed && !is_driven(island)) obstacles &= ~IslandObstacles::kPulled;
    upset_.clear();
    if ((obstacles & IslandObstacles::kBeyond) ||
        (meshed ? can_do_work(world, island) : obstacles != 0)) {
        if (is_tied && !meshed) leave(world, island, pairs);
        return IslandWay::left;
    }
    const bool large = is_large(world.settings, n);
    if (large && rests_and_misses(world, island, pairs)) return IslandWay::exact;
    if (large || waits_for_rest(world, island, pairs)) {
        leave(world, island, pairs);
        return IslandWay::left;
    }
    if ((obstacles & (IslandObstacles::kHard | IslandObstacles::kPulled)) ||
        ((obstacles & IslandObstacles::kRests) && !is_driven(island)) ||
        (meshed && is_driven(island) && is_torn(world, island)))
        return IslandWay::swept;
    if (n <= kVerySmall && flies(world, island, pairs)) return IslandWay::exact;
    const std::size_t jammed_before = jammed_.size();
    find_upset(world, island, pairs);
    const bool is_loose = is_loose_heap(island);
    const bool hard = is_hard(world, island, pairs);
    const bool is_held = upset_.empty() || (hard && is_tied && !is_driven(island));
    if ((is_held || is_loose) && (n <= kVerySmall || is_calm(world, island, pairs, hard))) {
        if (is_held) return IslandWay::exact;
        jammed_.resize(jammed_before);
        return IslandWay::swept;
    }
    if (meshed && !is_driven(island)) return IslandWay::swept;
    leave(world, island, pairs);
    return IslandWay::left;
}

bool IslandChoice::flies(const World& world, const ContactIsland& island,
                         const std::vector<BodyPair>& pairs) const {
    const auto is_free = [&](const BodyPair& pair) {
        return pair.row_a < world.dynamic_count && pair.row_b < world.dynamic_count;
    };
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i)
        if (!is_free(pairs[found_.pairs()[i]])) return false;
    for (std::uint32_t i = island.first_tie; i < island.last_tie; ++i)
        if (!is_free(ties_.rows()[found_.ties()[i]])) return false;
    return true;
}

bool IslandChoice::is_slow(const World& world, const Contact& contact) const {
    const Bodies& b = world.bodies;
    const std::uint32_t body = b.motion[contact.a] == Motion::dynamic ? contact.a : contact.b;
    const double speed =
        b.velocity[body].norm() + b.bounding_radius[body] * b.angular_velocity[body].norm();
    return speed <= calm_speed(world, b.bounding_radius[body], pull_on(world, body));
}

void IslandChoice::find_upset(const World& world, const ContactIsland& island,
                              const std::vector<BodyPair>& pairs) {
    const Bodies& b = world.bodies;
    const double jam = is_driven(island) ? kJam : kDeep;
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
        const BodyPair& pair = pairs[found_.pairs()[i]];
        const Contact& first = world.contacts.found[pair.first];
        const double radius = smaller_radius(b, first);
        bool upset = false;
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k) {
            const double overlap = -world.contacts.found[k].gap;
            const ContactMemory& before = world.contacts.memory[k];
            const bool jammed =
                overlap > jam * radius && (is_stuck(before, overlap) || before.jammed);
            if (jammed) jammed_.push_back(k);
            upset |= jammed || overlap > kDeep * radius;
        }
        if (upset) upset_.push_back(pair);
    }
}

void IslandChoice::leave(const World& world, const ContactIsland& island,
                         const std::vector<BodyPair>& pairs) {
    // what others squeeze is jammed as a whole
    if (!upset_.empty() && is_driven(island)) return;
    const std::vector<ContactMemory>& memory = world.contacts.memory;
    const auto was_exact = [&](std::uint32_t at) {
        const auto first = memory.begin() + pairs[at].first;
        return std::any_of(first, first + pairs[at].count,
                           [](const ContactMemory& m) { return m.matched && m.exact; });
    };
    const auto first = found_.pairs().begin();
    if (std::none_of(first + island.first_pair, first + island.last_pair, was_exact)) return;
    const double bears = weight_of(world, island, pairs) * substep_of(world.settings);
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i)
        mark(world, pairs[found_.pairs()[i]], bears);
    for (const BodyPair& pair : upset_) mark(world, pair, 0);
}

double IslandChoice::weight_of(const World& world, const ContactIsland& island,
                               const std::vector<BodyPair>& pairs) {
    weighed_.assign(island.last_body - island.first_body, 0);
    double weight = 0;
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
        const Contact& c = world.contacts.found[pairs[found_.pairs()[i]].first];
        for (const std::uint32_t body : {c.a, c.b}) {
            if (world.bodies.motion[body] != Motion::dynamic) continue;
            std::uint8_t& weighed = weighed_[found_.index_in_island(world.bodies.row[body])];
            if (!weighed) weight += world.bodies.mass[body] * pull_on(world, body);
            weighed = 1;
        }
    }
    return weight;
}

void IslandChoice::mark(const World& world, const BodyPair& pair, double bears) {
    for (const std::int32_t row : {pair.row_a, pair.row_b})
        if (row < world.dynamic_count) bears_[static_cast<std::size_t>(row)] = bears;
}

template <class VelocityAt>
IslandChoice::Stir IslandChoice::stir_of(const World& world, const ContactIsland& island,
                                         const std::vector<BodyPair>& pairs,
                                         VelocityAt velocity_at) const {
    const Bodies& b = world.bodies;
    Stir stir;
    double squares = 0, contacts = 0;
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
        const BodyPair& pair = pairs[found_.pairs()[i]];
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
            squares += velocity_at(k).squaredNorm();
        contacts += pair.count;
        const Contact& c = world.contacts.found[pair.first];
        for (const std::uint32_t body : {c.a, c.b}) {
            if (b.motion[body] != Motion::dynamic) continue;
            stir.radius = std::max(stir.radius, b.bounding_radius[body]);
            stir.pull = std::max(stir.pull, pull_on(world, body));
        }
    }
    if (contacts > 0) stir.speed = std::sqrt(squares / contacts);
    return stir;
}

bool IslandChoice::is_hard(const World& world, const ContactIsland& island,
                           const std::vector<BodyPair>& pairs) const {
    const std::uint32_t n = island.last_body - island.first_body,
                        ties = island.last_tie - island.first_tie;
    if (n > kMostHard) return false;
    if (ties > 0) return !is_meshed(island) && (n <= kFewHard || 2 * ties >= n);
    const auto first = found_.pairs().begin();
    return std::any_of(first + island.first_pair, first + island.last_pair, [&](std::uint32_t i) {
        return is_uneven(world.bodies, world.contacts.found[pairs[i].first]);
    });
}

bool IslandChoice::is_calm(const World& world, const ContactIsland& island,
                           const std::vector<BodyPair>& pairs, bool hard) const {
    const Stir stir =
        stir_of(world, island, pairs, [&](std::uint32_t k) { return relative_velocity(world, k); });
    return stir.speed <= calm_speed(world, stir.radius, stir.pull) ||
           (hard &&
            stir.speed * substep_of(world.settings) <=
                (island.first_tie < island.last_tie ? kTreeFollowed : kHeapFollowed) * stir.radius);
}

/// Of a large island: see islands/large_islands.h.
bool IslandChoice::rests_and_misses(const World& world, const ContactIsland& island,
                                    const std::vector<BodyPair>& pairs) const {
    if (!(world.settings.accuracy > 0) || !is_loose(island)) return false;
    std::uint8_t missed = 0;
    std::uint32_t known = 0;
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
        const ContactMemory& memory = world.contacts.memory[pairs[found_.pairs()[i]].first];
        missed = std::max(missed, memory.missed), known += memory.matched;
    }
    const bool is_new = 2 * known < island.last_pair - island.first_pair;
    if (waits(missed) || (missed == 0 && !is_new)) return false;
    return rests(world, island, pairs);
}

/// Of a heap that is not large: whether most of it was given up, and moves. What comes to it does
/// not wait.
bool IslandChoice::waits_for_rest(const World& world, const ContactIsland& island,
                                  const std::vector<BodyPair>& pairs) const {
    if (!is_loose(island) || island.last_body - island.first_body <= kHeap) return false;
    const auto given_up = [](const ContactMemory& m) { return waits(m.missed); };
    return most_of(world, island, pairs, given_up) && !rests(world, island, pairs);
}

bool IslandChoice::moved_on(const World& world, const ContactIsland& island,
                            const std::vector<BodyPair>& pairs) const {
    return most_of(world, island, pairs, [](const ContactMemory& m) { return m.moved; });
}

/// Whether what most of the pairs remember is so.
template <class Is>
bool IslandChoice::most_of(const World& world, const ContactIsland& island,
                           const std::vector<BodyPair>& pairs, Is is) const {
    std::uint32_t known = 0, so = 0;
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
        const ContactMemory& memory = world.contacts.memory[pairs[found_.pairs()[i]].first];
        known += memory.matched, so += memory.matched && is(memory);
    }
    return 2 * so > known;
}

bool IslandChoice::rests(const World& world, const ContactIsland& island,
                         const std::vector<BodyPair>& pairs) const {
    const Bodies& b = world.bodies;
    bool is_deep = false;
    const Stir stir = stir_of(world, island, pairs, [&](std::uint32_t k) {
        const Contact& contact = world.contacts.found[k];
        is_deep |= -contact.gap > kDeep * smaller_radius(b, contact);
        return relative_velocity(b, b.velocity_now, b.angular_velocity_now, contact,
                                 world.contacts.point[k]);
    });
    return !is_deep && stir.speed <= kRestsBelow * stir.pull * substep_of(world.settings);
}

bool IslandChoice::goes_on(const World& world, std::uint32_t contact) const {
    const Contact& c = world.contacts.found[contact];
    const double impulse = world.contacts.memory[contact].normal_impulse;
    double pull = 0;
    for (const std::uint32_t body : {c.a, c.b}) {
        if (world.bodies.motion[body] != Motion::dynamic) continue;
        if (impulse > bears_[world.bodies.row[body]]) return false;
        pull = std::max(pull, pull_on(world, body));
    }
    const double fallen = pull * substep_of(world.settings);
    return relative_velocity(world, contact).norm() <= kPulledOn * fallen;
}

bool IslandChoice::is_stuck(const ContactMemory& before, double overlap) const {
    return before.known && before.exact && overlap > -stuck_share_ * before.gap;
}

}  // namespace plumb
