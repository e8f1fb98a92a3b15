// SPDX-License-Identifier: MIT
#include "solve/island_residuals.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Adds what its constraints tell to what its bodies do.
void put_residual(IslandResidual& island, const ResidualSum& sum, double h) {
    if (!(island.weight > 0)) island.weight = sum.push / h;
    island.exact = !sum.swept;
    island.force = std::sqrt(sum.worst) / h;
    island.rms_force = std::sqrt(sum.sum / sum.count) / h;
    island.error = std::sqrt(sum.error) * h;
}

}  // namespace

void add_tied_rows(const World& world, std::vector<BodyPair>& pairs) {
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        pairs.push_back({world.row_of(a), world.row_of(b), 0, 1});
    };
    for (const Joint& joint : world.joints.joints)
        if (!joint.broken) add(joint.a, joint.b);
    for (const Link& link : world.links)
        if (link.is_between_bodies()) add(link.a.body, link.b.body);
}

void IslandResiduals::take(const World& world, const ContactIslands& found) {
    island_ = found.island_of();
    weigh(world, found.islands().size());
}

/// How many bodies each island has, and what they weigh.
void IslandResiduals::weigh(const World& world, std::size_t count) {
    sums_.reserve(island_.size()), islands_.reserve(island_.size());
    told_.reserve(island_.size());
    sums_.assign(count, {});
    islands_.assign(count, {});
    const double g = world.settings.gravity.norm();
    for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
        const auto row = static_cast<std::size_t>(world.bodies.row[i]);
        if (row >= island_.size() || island_[row] == kNoIsland) continue;
        IslandResidual& island = islands_[island_[row]];
        island.first_body = std::min(island.first_body, i);
        island.weight += g * world.bodies.mass[i];
        ++island.bodies;
    }
}

StepResidual IslandResiduals::find(double h) {
    StepResidual step;
    told_.assign(sums_.size(), kNoIsland);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (sums_[i].count == 0) continue;
        told_[i] = step.islands;
        IslandResidual& island = islands_[step.islands];
        island = islands_[i];
        put_residual(island, sums_[i], h);
        step.force = std::max(step.force, island.force);
        step.error = std::max(step.error, island.error);
        if (step.islands++ == 0 || island.force_of_weight() > step.worst.force_of_weight())
            step.worst = island;
    }
    islands_.resize(step.islands);
    return step;
}

}  // namespace plumb
