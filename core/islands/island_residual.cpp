// SPDX-License-Identifier: MIT
/// Residuals of islands that are solved as one (effects/residual.h): contacts by the formulas of
/// swept rows, ties by the answers of their rows.
#include "constraints/friction.h"
#include "islands/island_group.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Friction by the least mass of the point in any direction.
ResidualSum residual_of(const Island& island, const IslandPoint& p) {
    const Vector6d lack = p.wanted - velocity_of(p, island.velocity);
    const double push = p.impulse[0], m = p.mass;
    const double normal = std::clamp(push + p.mass_normal * lack[0], 0.0, p.cone.most) - push;
    Planar<double> friction{p.impulse[1], p.impulse[2]};
    const Planar<double> across = solve_friction<double>(friction, {0, 0}, {-lack[1], -lack[2]},
                                                         {m, 0, m, m}, p.cone.friction * push);
    const double pushed = normal * normal, slid = across.x * across.x + across.y * across.y;
    return {pushed + slid, pushed + slid,
            std::max(pushed / (p.mass_normal * p.mass_normal), slid / (m * m)), push, 1};
}

ResidualSum residual_of(const Island& island, const TieRow& row) {
    const double rate = rate_of(row, island.velocity);
    const double off = answer_of(row, rate, row.mass).impulse - row.impulse;
    const double impulse = off / row.length, speed = off / row.mass * row.length;
    return {impulse * impulse, impulse * impulse, speed * speed, 0, 1};
}

}  // namespace

void IslandGroup::add_rows(const World& world, std::vector<BodyPair>& pairs) const {
    const auto row_of = [&](std::uint32_t i) { return world.bodies.row[columns_.bodies[i].body]; };
    for (const ExactIsland& island : taken())
        for (std::uint32_t k = island.first_body; k < island.last_body; ++k)
            pairs.push_back({row_of(island.first_body), row_of(k), 0, 1});
}

void IslandGroup::add_residuals(const World& world, IslandResiduals& islands) {
    for (const ExactIsland& member : taken()) {
        const Island island = columns_.all_of(member);
        ResidualSum sum;
        for (const IslandPoint& point : island.points) sum.add(residual_of(island, point));
        for (const TieRow& row : island.rows) sum.add(residual_of(island, row));
        sum.swept = member.effort == IslandEffort::swept || !member.solved ||
                    member.open > world.settings.joint_tolerance;
        const std::int32_t row = world.bodies.row[island.bodies[0].body];
        islands.add(row, row, sum);
    }
}

}  // namespace plumb
