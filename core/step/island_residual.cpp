// SPDX-License-Identifier: MIT
/// Residuals of islands that are solved as one (effects/residual.h): contacts by the formulas of
/// swept rows, ties by the answers of their rows.
#include "constraints/friction.h"
#include "step/island_group.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

InverseMass<double> inverse_mass_of(const Island& island, std::uint32_t body) {
    if (body == kImmovable) return {0, {0, 0, 0, 0, 0, 0}};
    return {1 / island.bodies[body].mass, island.bodies[body].inverse_inertia};
}

/// Inverse of what the bodies answer along the point's two tangents.
TangentMass<double> tangent_mass_of(const Island& island, const IslandPoint& p) {
    const InverseMass<double> of_a = inverse_mass_of(island, p.a),
                              of_b = inverse_mass_of(island, p.b);
    const auto k = [&](int i, int j) -> double {
        const Vector3d d = p.frame.col(i), e = p.frame.col(j);
        return response<double>(of_a, p.arm_a, d, e) + response<double>(of_b, p.arm_b, d, e);
    };
    return tangent_mass<double>(k(1, 1), k(1, 2), k(2, 2), [](double x) { return 1 / x; });
}

ResidualSum residual_of(const Island& island, const IslandPoint& p) {
    const Vector6d lack = p.wanted - velocity_of(p, island.velocity);
    const double push = p.impulse[0];
    const double normal = std::clamp(push + p.mass_normal * lack[0], 0.0, p.cone.most) - push;
    const TangentMass<double> mass = tangent_mass_of(island, p);
    Planar<double> friction{p.impulse[1], p.impulse[2]};
    const Planar<double> across = solve_friction<double>(friction, {0, 0}, {-lack[1], -lack[2]},
                                                         mass, p.cone.friction * push);
    const double slid = across.x * across.x + across.y * across.y;
    const double slip = lack[1] * lack[1] + lack[2] * lack[2];
    const double squared = normal * normal + slid;
    const double error = std::max(normal * normal / (p.mass_normal * p.mass_normal),
                                  std::min(slip, slid / (mass.least * mass.least)));
    return {squared, squared, error, push, 1};
}

ResidualSum residual_of(const Island& island, const IslandRow& row) {
    const double rate = rate_of(row, island.velocity);
    const double off = answer_of(row, rate, row.mass).impulse - row.impulse;
    const double impulse = off / row.length, speed = off / row.mass * row.length;
    return {impulse * impulse, impulse * impulse, speed * speed, 0, 1};
}

}  // namespace

void IslandGroup::join_islands(const World& world, IslandResiduals& islands) const {
    for (std::size_t i = 0; i < count_; ++i) {
        const std::int32_t first = world.bodies.row[bodies_[members_[i].first_body].body];
        for (std::uint32_t k = members_[i].first_body + 1; k < members_[i].last_body; ++k)
            islands.join(first, world.bodies.row[bodies_[k].body]);
    }
}

void IslandGroup::add_residuals(const World& world, IslandResiduals& islands) {
    for (std::size_t i = 0; i < count_; ++i) {
        const Member& member = members_[i];
        const Island island = island_of(member);
        ResidualSum sum;
        for (const IslandPoint& point : island.points) sum.add(residual_of(island, point));
        for (const IslandRow& row : island.rows) sum.add(residual_of(island, row));
        const std::int32_t row = world.bodies.row[bodies_[member.first_body].body];
        islands.add(row, row, sum);
        if (member.effort != IslandEffort::swept && member.solved) islands.mark_exact(row);
    }
}

}  // namespace plumb
