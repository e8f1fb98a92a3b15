// SPDX-License-Identifier: MIT
#include "solve/elastic_tie_choice.h"

#include "constraints/substep_time.h"
#include "ties/lever_of.h"
#include "ties/tie_load.h"

#include <algorithm>

namespace plumb {
namespace {

/// What turns farther within a substep [rad], or swings under a harder pull (the square of h ω), is
/// solved by others: levers of the substep's start say little of its end. What lies on a sheet
/// swings less.
constexpr double kFarTurn = 1, kHardPull = 1, kHeldPull = 4;

/// The square of h ω of a joint that bears `impulse` [N s].
double pull_of(const World& world, const Joint& joint, double impulse, double h) {
    const Bodies& b = world.bodies;
    double pull = 0;
    const auto see = [&](std::uint32_t body, const Placement& frame) {
        if (body == kNoIndex || b.motion[body] != Motion::dynamic) return;
        pull = std::max(pull, lever_load<double>(impulse, 0, b.orientation[body] * frame.position,
                                                 b.world_inverse_inertia[body], h));
    };
    see(joint.a, joint.frame_a), see(joint.b, joint.frame_b);
    return pull;
}

/// Of a joint that pulls by `pull`, in the same measure: what a blow leaves with it is no load, so
/// of what it bore in the last two substeps the less counts; where it is new, the weight of all
/// that hangs together, in a substep [N s].
double lasting_pull(const World& world, const Joint& joint, double pull, double weight, double h) {
    const double bore = load_of(joint, kAlongX, JointSolve::tree);
    if (bore == 0) return pull_of(world, joint, weight, h);
    return pull * load_of(joint, kAlongX, JointSolve::iterations) / bore;
}

/// `lies`: whether one of its bodies does; `weight`: of all that hang together [N s].
bool belongs(const World& world, const Tie& tie, bool lies, double weight, double h) {
    const double most = lies ? kHeldPull : kHardPull;
    if (tie.kind == TieKind::link) {
        const TieLoad load = load_of(world, world.links[tie.index], h);
        return load.turn <= kFarTurn && load.pull <= most;
    }
    if (world.settings.joints == JointMethod::iterate) return false;
    if (tie.kind == TieKind::coupling) return true;
    const Joint& joint = world.joints.joints[tie.index];
    const TieLoad load = load_of(world, joint, h);
    return !joint.pace.is_divided() && load.turn <= kFarTurn &&
           lasting_pull(world, joint, load.pull, weight, h) <= most;
}

bool moves(const World& world, std::uint32_t body) {
    return body != kNoIndex && world.bodies.inverse_mass[body] > 0;
}

}  // namespace

void ElasticTieChoice::find_groups(const World& world) {
    const std::size_t n = world.bodies.size();
    groups_.reset(n);
    for (const Tie& tie : list_.all()) unite_bodies(world, tie, groups_);
    const double h = substep_of(world.settings);
    weight_.assign(n, 0), is_other_.assign(n, 0), lies_.assign(n, 0);
    world.each_body_among_particles([&](std::uint32_t body) {
        if (body != kNoIndex) lies_[body] = 1;
    });
    for (std::uint32_t i = 0; i < n; ++i)
        if (moves(world, i))
            weight_[groups_.lowest(i)] += h * world.bodies.mass[i] * pull_on(world, i);
}

const std::vector<Tie>& ElasticTieChoice::find(const World& world, bool takes_bodies) {
    found_.clear();
    if (takes_bodies) find_of_bodies(world);
    for (std::uint32_t i = 0; i < world.links.size(); ++i)
        if (!world.links[i].is_between_bodies()) found_.push_back({TieKind::link, i});
    return found_;
}

void ElasticTieChoice::find_of_bodies(const World& world) {
    list_.find(world);
    find_groups(world);
    const double h = substep_of(world.settings);
    const auto each_group = [&](const Tie& tie, auto visit) {
        each_body(world, tie, [&](std::uint32_t body) {
            if (moves(world, body)) visit(groups_.lowest(body));
        });
    };
    for (const Tie& tie : list_.all()) {
        double weight = 0;
        each_group(tie, [&](std::uint32_t group) { weight = std::max(weight, weight_[group]); });
        bool lies = false;
        each_body(world, tie,
                  [&](std::uint32_t body) { lies |= moves(world, body) && lies_[body] != 0; });
        if (belongs(world, tie, lies, weight, h)) continue;
        each_group(tie, [&](std::uint32_t group) { is_other_[group] = 1; });
    }
    for (const Tie& tie : list_.all()) {
        bool other = false;
        each_group(tie, [&](std::uint32_t group) { other |= is_other_[group] != 0; });
        if (!other) found_.push_back(tie);
    }
}

}  // namespace plumb
