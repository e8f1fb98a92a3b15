// SPDX-License-Identifier: MIT
#pragma once

#include "schedule/contact_islands.h"
#include "step/contact_solver.h"

namespace plumb {

/// Keeps a share of what a substep changed of an island's velocities, and of its contacts'
/// impulses, which keeps the sums of momentum. `bodies`: their rows.
template <class Real, int W>
void keep_share(double share, const ContactIslands& islands, const ContactIsland& island,
                ContactSolver<Real, W>& contacts, const BodyRows<Real>& bodies) {
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i)
        contacts.scale_impulses(islands.pairs()[i], share);
    for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
        const std::int32_t row = islands.bodies()[i];
        Velocity<Real> change = velocity_in(bodies.change, row);
        if (share > 0)
            change.v *= static_cast<Real>(share), change.w *= static_cast<Real>(share);
        else  // also of what is not a number
            change.v.setZero(), change.w.setZero();
        put_velocity(bodies.change, row, change);
    }
}

}  // namespace plumb
