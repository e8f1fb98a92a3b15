// SPDX-License-Identifier: MIT
#include "solve/island_residuals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

void IslandResiduals::take(const World& world, const ContactIslands& found) {
    island_ = found.island_of();
    weigh(world, found.islands().size());
}

void IslandResiduals::join_ties(const World& world) {
    parent_.resize(static_cast<std::size_t>(world.dynamic_count));
    std::iota(parent_.begin(), parent_.end(), 0);
    const auto row_of = [&](std::uint32_t body) {
        return body == kNoIndex ? world.zero_row() : world.bodies.row[body];
    };
    for (const Joint& joint : world.joints.joints)
        if (!joint.broken) join(row_of(joint.a), row_of(joint.b));
    for (const Link& link : world.links)
        if (link.is_between_bodies()) join(row_of(link.a.body), row_of(link.b.body));
}

/// A body by itself is an island, too.
void IslandResiduals::end_joining(const World& world) {
    island_.resize(parent_.size());
    std::uint32_t count = 0;
    for (std::size_t row = 0; row < parent_.size(); ++row) {
        const auto parent = static_cast<std::size_t>(parent_[row]);
        island_[row] = parent == row ? count++ : island_[parent];
    }
    weigh(world, count);
}

/// How many bodies each island has, and what they weigh.
void IslandResiduals::weigh(const World& world, std::size_t count) {
    sums_.reserve(island_.size()), islands_.reserve(island_.size());
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
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (sums_[i].count == 0) continue;
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
