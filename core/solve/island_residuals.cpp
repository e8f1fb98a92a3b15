// SPDX-License-Identifier: MIT
#include "solve/island_residuals.h"

#include "world/tie.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumb {
namespace {

/// `bodies`: with what its bodies tell.
IslandResidual island_residual(const IslandResidual& bodies, const ResidualSum& sum, double h) {
    IslandResidual island = bodies;
    if (!(island.weight > 0)) island.weight = sum.push / h;
    island.force = std::sqrt(sum.worst) / h;
    island.rms_force = std::sqrt(sum.sum / sum.count) / h;
    island.error = std::sqrt(sum.error) * h;
    return island;
}

}  // namespace

void IslandResiduals::join_ties(const World& world) {
    const auto count = static_cast<std::size_t>(world.dynamic_count);
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0);
    sums_.assign(count, {});
    bodies_.assign(count, {});
    islands_.reserve(count);
    const auto row_of = [&](std::uint32_t body) {
        return body == kNoIndex ? world.zero_row() : world.bodies.row[body];
    };
    for (const Joint& joint : world.joints.joints)
        if (!joint.broken) join(row_of(joint.a), row_of(joint.b));
    for (const Link& link : world.links)
        if (link.is_between_bodies()) join(row_of(link.a.body), row_of(link.b.body));
}

void IslandResiduals::end_joining() {
    for (std::int32_t& row : parent_) row = parent_[parent_[row]];
}

/// How many bodies each island has, and what they weigh.
void IslandResiduals::weigh(const World& world) {
    const double g = world.settings.gravity.norm();
    for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
        if (world.bodies.motion[i] != Motion::dynamic) continue;
        IslandResidual& island = bodies_[parent_[world.bodies.row[i]]];
        island.first_body = std::min(island.first_body, i);
        island.weight += g * world.bodies.mass[i];
        ++island.bodies;
    }
}

StepResidual IslandResiduals::find(const World& world, double h) {
    weigh(world);
    StepResidual step;
    for (std::size_t root = 0; root < sums_.size(); ++root) {
        if (sums_[root].count == 0) continue;
        const IslandResidual& island =
            islands_.emplace_back(island_residual(bodies_[root], sums_[root], h));
        step.force = std::max(step.force, island.force);
        step.error = std::max(step.error, island.error);
        if (step.islands++ == 0 || island.force_of_weight() > step.worst.force_of_weight())
            step.worst = island;
    }
    return step;
}

}  // namespace plumb
