// SPDX-License-Identifier: MIT
#include "islands/island_group.h"

#include "constraints/substep_time.h"
#include "contacts/contact_measures.h"
#include "islands/exact_impacts.h"
#include "islands/island_demands.h"
#include "islands/island_loan.h"
#include "islands/island_substep.h"
#include "islands/large_islands.h"
#include "solve/free_turn.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Index of a body among those of its island, or kImmovable.
std::uint32_t index_in_island(const World& world, const ContactIslands& islands,
                              std::uint32_t body) {
    if (body == kNoIndex || world.bodies.motion[body] != Motion::dynamic) return kImmovable;
    return islands.index_in_island(world.bodies.row[body]);
}

/// An island whose joints stay open by kAjar tolerances is given up for twice this long [s], and
/// twice as long with each time that it fails again; a tree for twice this less, so that it is
/// tried once more at once.
constexpr double kRest = 0.1;
constexpr std::uint32_t kMostMisses = 8;

}  // namespace

IslandGroup::IslandGroup(const Plan& plan, Workers& workers, SolvedTies& solved)
    : workers_(workers), solved_(solved), columns_(plan), solvers_(workers.count()) {}

// ---- once a step

void IslandGroup::load(const World& world, std::vector<BodyPair>& pairs) {
    count_ = 0, costly_ = 0;
    set_aside_.clear(), loose_.clear(), columns_.clear();
    const ContactIslands& found = choice_.find(world, pairs, solved_);
    is_taken_.assign(pairs.size(), 0);
    for (const ContactIsland& from : found.islands()) {
        const IslandWay way = choice_.way_of(world, from, pairs);
        if (way == IslandWay::left) continue;
        if (!take(world, from, pairs)) {
            set_aside(world, from, pairs);
            continue;
        }
        choose_effort(world, taken().back(), way == IslandWay::swept);
        note_loose(world, taken().back(), from, pairs);
    }

    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (!is_taken_[i]) pairs[kept++] = pairs[i];
    pairs.resize(kept);
    columns_.size_velocities();
    columns_.take_geometry(world);
    if (world.settings.warm_start)
        for (const ExactIsland& island : taken()) columns_.take_memory(world, island);
    is_fresh_ = true;
}

/// Returns whether its solution does not take too much; else nothing is taken.
bool IslandGroup::take(const World& world, const ContactIsland& from,
                       const std::vector<BodyPair>& pairs) {
    if (count_ == islands_.size()) islands_.emplace_back();
    ExactIsland& island = islands_[count_];
    if (!find_system(world, island, from, pairs)) return false;
    ++count_;
    find_nature(world, island, from, pairs);
    fill_columns(world, island, from, pairs);
    island.account = account_of(world, island);
    island.given_up = false;
    island.open = 0;
    return true;
}

/// The system of the island's pairs and ties, if its solution does not take too much.
bool IslandGroup::find_system(const World& world, ExactIsland& island, const ContactIsland& from,
                              const std::vector<BodyPair>& pairs) {
    const ContactIslands& found = choice_.islands();
    pattern_.clear();
    for (std::uint32_t i = from.first_pair; i < from.last_pair; ++i) {
        const BodyPair& pair = pairs[found.pairs()[i]];
        if (std::max(pair.row_a, pair.row_b) < world.dynamic_count)
            pattern_.emplace_back(found.index_in_island(pair.row_a),
                                  found.index_in_island(pair.row_b));
    }
    for (std::uint32_t i = from.first_tie; i < from.last_tie; ++i) {
        tied_.clear();
        each_body(world, choice_.tie(found.ties()[i]), [&](std::uint32_t body) {
            const std::uint32_t here = index_in_island(world, found, body);
            if (here == kImmovable) return;
            for (const std::uint32_t other : tied_)
                if (other != here) pattern_.emplace_back(other, here);
            tied_.push_back(here);
        });
    }
    const std::uint32_t n = from.last_body - from.first_body;
    if (island.system.rows() == n && island.pattern == pattern_) return true;
    std::swap(island.pattern, pattern_);
    const bool large = is_large(world.settings, n);
    return island.system.analyse(n, island.pattern, large,
                                 large ? most_products(n) / kFewest : kAnyProducts, spare_);
}

/// What it is, which decides how it is treated.
void IslandGroup::find_nature(const World& world, ExactIsland& island, const ContactIsland& from,
                              const std::vector<BodyPair>& pairs) const {
    const std::uint32_t n = from.last_body - from.first_body;
    island.is_large = is_large(world.settings, n);
    island.is_driven = choice_.is_driven(from);
    island.is_meshed = choice_.is_meshed(from) && !island.is_driven;
    island.flies = choice_.flies(world, from, pairs);
    island.gains_nothing = !island.is_driven && !choice_.can_do_work(world, from);
    island.may_be_disputed = choice_.is_loose_heap(from);
    island.may_give_up = island.is_driven || !choice_.is_hard(world, from, pairs);
    const bool is_heap = !island.is_large && island.may_be_disputed && n > kHeap;
    island.moves = is_heap && !choice_.rests(world, from, pairs);
    island.moved_on = island.moves && choice_.moved_on(world, from, pairs);
}

/// What does not bounce is brought to rest with its forces, unless its solution cannot be relied
/// on.
void IslandGroup::note_loose(const World& world, const ExactIsland& island,
                             const ContactIsland& from, const std::vector<BodyPair>& pairs) {
    const bool is_tied = from.first_tie != from.last_tie;
    const std::uint32_t n = island.body_count();
    if (is_tied || n == 1 || n > kMostExactlyHit) return;
    const auto first = choice_.islands().pairs().begin() + from.first_pair,
               last = choice_.islands().pairs().begin() + from.last_pair;
    const bool bounces = std::any_of(first, last, [&](std::uint32_t i) {
        const Contact& c = world.contacts.found[pairs[i].first];
        return world.surface_pair(c.a, c.b).restitution > 0;
    });
    if (!bounces && (island.is_driven || island.effort == IslandEffort::full)) return;
    std::for_each(first, last, [&](std::uint32_t i) { loose_.push_back(pairs[i]); });
}

/// Its bodies, contacts and ties go into the columns, and nobody else solves them in this step.
void IslandGroup::fill_columns(const World& world, ExactIsland& island, const ContactIsland& from,
                               const std::vector<BodyPair>& pairs) {
    const ContactIslands& found = choice_.islands();
    std::vector<SolvedBody>& bodies = columns_.bodies;
    island.first_body = static_cast<std::uint32_t>(bodies.size());
    island.first_point = static_cast<std::uint32_t>(columns_.points.size());
    columns_.ties.begin_range(island.ties);
    bodies.resize(bodies.size() + from.last_body - from.first_body);
    const auto place = [&](std::uint32_t body) {
        const std::uint32_t here = index_in_island(world, found, body);
        if (here != kImmovable) bodies[island.first_body + here].body = body;
        return here;
    };
    for (std::uint32_t i = from.first_pair; i < from.last_pair; ++i) {
        const std::uint32_t at = found.pairs()[i];
        const BodyPair& pair = pairs[at];
        is_taken_[at] = 1;
        const Contact& first = world.contacts.found[pair.first];
        const std::uint32_t a = place(first.a), b = place(first.b);
        for (std::uint32_t k = 0; k < pair.count; ++k)
            columns_.add_point(world, pair.first + k, a, b);
    }
    for (std::uint32_t i = from.first_tie; i < from.last_tie; ++i) {
        const Tie& tie = choice_.tie(found.ties()[i]);
        TiedBodies at{};
        std::size_t k = 0;
        each_body(world, tie, [&](std::uint32_t body) { at[k++] = place(body); });
        columns_.ties.add(world, tie, at);
        solved_.mark(tie);
    }
    island.last_body = static_cast<std::uint32_t>(bodies.size());
    island.last_point = static_cast<std::uint32_t>(columns_.points.size());
    columns_.ties.end_range(island.ties);
}

/// Of a large island, or of a heap that moves: with what it has taken in vain until now.
IslandAccount IslandGroup::account_of(const World& world, const ExactIsland& island) const {
    IslandAccount account;
    if (island.is_large)
        account = IslandAccount::of_large(island.system.rows(), island.system.block_products());
    else if (island.moves && !island.moved_on)
        account = IslandAccount::of_heap(island.system.block_products());
    if (!account.is_kept()) return account;
    for (const std::uint32_t contact : points_in(columns_.contacts, island)) {
        const ContactMemory& memory = world.contacts.memory[contact];
        if (memory.matched) account.recall(memory.missed);
    }
    return account;
}

/// What would take too much is left to sweeps, and tried again after a while.
void IslandGroup::set_aside(const World& world, const ContactIsland& from,
                            const std::vector<BodyPair>& pairs) {
    choice_.leave(world, from, pairs);
    for (std::uint32_t i = from.first_pair; i < from.last_pair; ++i)
        set_aside_.push_back(pairs[choice_.islands().pairs()[i]]);
    ++costly_;
}

/// Whether nothing in it overlaps by much.
bool IslandGroup::is_shallow(const World& world, const ExactIsland& island) const {
    const std::span<const std::uint32_t> contacts = points_in(columns_.contacts, island);
    return std::all_of(contacts.begin(), contacts.end(), [&](std::uint32_t i) {
        const Contact& contact = world.contacts.found[i];
        return -contact.gap <= kShallow * smaller_radius(world.bodies, contact);
    });
}

/// What its contacts remember of settling and of a dispute.
void IslandGroup::recall(const World& world, ExactIsland& island) const {
    island.disputed = island.settling = 0;
    island.overlap = island.overlap_before = 0;
    for (const std::uint32_t contact : points_in(columns_.contacts, island)) {
        const ContactMemory& memory = world.contacts.memory[contact];
        island.settling = std::max(island.settling, memory.settling);
        if (!island.may_be_disputed) continue;
        island.overlap += std::max(0.0, -world.contacts.found[contact].gap);
        if (!memory.matched) continue;
        island.disputed = std::max(island.disputed, memory.disputed);
        island.overlap_before = std::max(island.overlap_before, double(memory.disputed_overlap));
    }
}

/// Whether it is solved exactly, and whether overlap is pushed out.
void IslandGroup::choose_effort(const World& world, ExactIsland& island, bool swept) const {
    recall(world, island);
    island.stirred = false;
    island.is_deep = swept;
    island.splits = island.opens = false;
    island.effort = swept ? IslandEffort::swept : IslandEffort::full;
    if (!island.may_be_disputed) return;
    const bool gives_way = island.overlap < kGivesWay * island.overlap_before;
    const bool begins =
        swept
            ? island.disputed == 0 || island.flies || (ends_sweeping(island.disputed) && gives_way)
            : effort_of(island.disputed) == IslandEffort::light && !is_shallow(world, island);
    if (begins) island.begin_dispute();
    island.effort = effort_of(island.disputed);
    island.splits = island.effort == IslandEffort::swept && !island.flies;
    island.opens = island.moves && island.splits && !is_shallow(world, island);
}

// ---- once a substep

std::uint32_t IslandGroup::begin(const World& world, double h, const PushOut& push_out) {
    if (!is_fresh_) columns_.take_geometry(world);
    is_fresh_ = false;
    columns_.take_velocities(world, h);
    columns_.ties.begin();
    for (ExactIsland& island : taken()) {
        columns_.ties.begin(world, substep_time(world, h), island.ties);
        if (!island.is_meshed && !island.is_driven)
            columns_.ties.stiffen(world, h, island.ties, bodies_in(columns_.bodies, island));
    }
    if (!world.settings.warm_start) columns_.forget_impulses();
    for (const ExactIsland& island : taken()) columns_.apply_impulses(island);
    IslandDemands demands(world, choice_, push_out, columns_);
    std::uint32_t clamped = 0;
    for (ExactIsland& island : taken()) clamped += demands.ask(island);
    return clamped;
}

void IslandGroup::solve(const World& world, StepReport& report) {
    workers_.run([&](std::uint32_t worker) {
        for (std::size_t i = worker; i < count_; i += workers_.count()) {
            IslandSubstep(world, columns_, solvers_[worker], islands_[i]).solve();
            bound_gain(world, columns_, islands_[i]);
        }
    });
    report.costly_islands = costly_;
    for (const ExactIsland& island : taken()) {
        report.unsolved_islands += !island.solved;
        if (island.open > world.settings.joint_tolerance) note_open(report, island);
    }
}

void IslandGroup::note_open(StepReport& report, const ExactIsland& island) const {
    const Tie& tie = columns_.ties.first_of(island.ties);
    if (tie.kind == TieKind::joint) report.open_trees.push_back({tie.index, island.open});
}

void IslandGroup::take_changes(Bodies& bodies) const { columns_.give_changes(bodies); }

/// What moves to another place with the velocity that it has would take angular momentum along.
void IslandGroup::open_apart(Bodies& bodies) const {
    for (const ExactIsland& island : taken()) {
        const auto each = [&](auto visit) {
            for (const SolvedBody& body : bodies_in(columns_.bodies, island))
                visit(body.body, {bodies.velocity[body.body], bodies.angular_velocity[body.body]});
        };
        if (!columns_.shifts(island)) continue;
        const Vector3d before = FreeBodies(bodies, each).momentum;
        columns_.give_shifts(bodies, island);
        if (!island.flies) continue;
        const FreeBodies after(bodies, each);
        const RigidMotion turn = after.turn_against(after.momentum - before);
        for (const SolvedBody& body : bodies_in(columns_.bodies, island)) {
            const Velocity<double> more = turn.of(bodies, body.body);
            bodies.velocity[body.body] += more.v, bodies.angular_velocity[body.body] += more.w;
        }
    }
}

void IslandGroup::add_impulses(ContactSums& sums) const { columns_.add_impulses(sums); }

void IslandGroup::store_tie_impulses(World& world) const {
    for (const ExactIsland& island : taken()) {
        columns_.ties.store_impulses(island.ties, bodies_in(columns_.velocity, island), world);
        store_loan(columns_, island, world);
    }
}

// ---- after the last substep

void IslandGroup::rest_ties(World& world) {
    if (!some_rest_ && count_ == 0) return;
    some_rest_ = false;
    const auto go_on = [this](IslandRest& rest) {
        if (rest.steps > 0) some_rest_ |= --rest.steps > 0;
    };
    for (Joint& joint : world.joints.joints) go_on(joint.island_rest);
    for (Link& link : world.links) go_on(link.island_rest);
    for (const ExactIsland& island : taken())
        columns_.ties.each(island.ties, [&](const Tie& tie) {
            if (tie.kind == TieKind::coupling) return;  // its joints rest
            IslandRest& rest = rest_of(world, tie);
            if (island.is_driven) {  // soon it is another one
                rest = {};
                return;
            }
            if (island.effort == IslandEffort::swept) return;  // nothing is learnt by sweeps
            rest.misses = island.given_up ? std::min(rest.misses + 1, kMostMisses) : 0;
            some_rest_ |= rest.misses > 0;
            // loops may contradict themselves; what a tree cannot do now it can in the next step
            const double shorter = island.is_meshed ? 0 : 2;
            if (rest.misses > 0)
                rest.steps = static_cast<std::uint32_t>(
                    std::ceil(kRest * (std::exp2(rest.misses) - shorter) / world.settings.dt));
        });
}

void IslandGroup::store_impulses(ContactTable& contacts) const {
    columns_.store_impulses(contacts);
    for (const ExactIsland& island : taken()) {
        const std::uint8_t settling =
            island.stirred ? kSettlingSteps : island.settling - (island.settling > 0);
        const bool in_vain = island.account.is_given_up();
        const std::uint8_t disputed =
            island.may_be_disputed && !in_vain ? disputed_after(island.disputed, island.solved) : 0;
        const std::uint8_t missed = island.account.missed();
        const bool goes_on = island.moved_on && (island.opens || !island.solved);
        for (const std::uint32_t contact : points_in(columns_.contacts, island)) {
            ContactMemory& memory = contacts.memory[contact];
            memory.disputed = disputed;
            memory.settling = settling;
            memory.missed = missed;
            memory.moved = island.moves && (in_vain || goes_on);
            memory.disputed_overlap = static_cast<float>(island.overlap_before);
        }
    }
    for (const std::uint32_t contact : choice_.jammed()) contacts.memory[contact].jammed = true;
    for (const BodyPair& pair : set_aside_)
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
            contacts.memory[k].missed = kTriesAgain;
}

}  // namespace plumb
