// SPDX-License-Identifier: MIT
#include "ties/tied_couplings.h"

#include "world/tie.h"

#include <algorithm>
#include <cmath>

namespace plumb {

void TiedCouplings::add(const World& world, std::uint32_t coupling, const TiedBodies& at) {
    Member& m = couplings_.emplace_back();
    m.coupling = coupling;
    m.at = at;
    std::size_t i = 0;
    each_body(world, {TieKind::coupling, coupling},
              [&](std::uint32_t body) { m.body[i++] = body; });
}

void TiedCouplings::begin(const World& world, const SubstepTime& time, std::uint32_t i,
                          std::vector<TieRow>& rows) {
    Member& m = couplings_[i];
    const JointCoupling& coupling = world.joints.couplings[m.coupling];
    const CouplingRow formula = coupling_row(world, coupling, time.h);
    m.deferred = formula.deferred;
    m.row = static_cast<std::uint32_t>(rows.size());
    TieRow& row = rows.emplace_back();
    row.wanted = -formula.bias;
    double mass = 0;
    for (std::uint32_t k = 0; k < formula.count; ++k) {
        const CouplingSide& side = formula.sides[k];
        const auto of = std::find(m.body.begin(), m.body.end(), side.body) - m.body.begin();
        Vector6d on;
        on << side.along, side.turn;
        row.add_side(m.at[of], on);
        mass += world.bodies.inverse_mass[side.body];
        const Velocity<double> scripted = scripted_velocity(world.bodies, side.body);
        if (m.at[of] == kImmovable)
            row.wanted -= side.along.dot(scripted.v) + side.turn.dot(scripted.w);
    }
    row.mass = 1 / formula.response(world.bodies);
    const bool slides = coupling.axis_b < kTurnX;
    row.length = slides ? 1 : std::sqrt(row.mass * mass);
    row.impulse = coupling.impulse;
}

double TiedCouplings::ask(std::uint32_t i, std::span<const Vector6d> velocity, double h,
                          std::vector<TieRow>& rows) const {
    const TieRow& row = rows[couplings_[i].row];
    return h * std::abs(rate_of(row, velocity) - row.wanted + row.softness * row.impulse);
}

void TiedCouplings::store_impulses(std::uint32_t i, const std::vector<TieRow>& rows,
                                   std::vector<JointCoupling>& couplings) const {
    const Member& m = couplings_[i];
    couplings[m.coupling].impulse = rows[m.row].impulse;
    couplings[m.coupling].deferred = m.deferred;
}

}  // namespace plumb
