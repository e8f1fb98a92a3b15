// SPDX-License-Identifier: MIT
/// The work that contacts' impulses do in a substep.
///
/// An impulse λ that changes the velocity at a contact from u to u + Δu does the work λ (u + Δu/2).
/// What pushes and rubs loses energy by it, but for what the substep asks for: a speed w at which old
/// overlap is pushed out, a collision bounces or anchors pull back. On the way from u to w that adds
/// λ p, with p = (u + w)/2 where that is positive. Iterations that are not finished may add more: a
/// heavy body that has come down on light ones is still carried by what stopped it, and thrown back.
#pragma once

#include "constraints/contact.h"
#include "schedule/contact_batches.h"
#include "solve/contact_iteration.h"
#include "step/contact_impulses.h"
#include "step/contact_sides.h"

#include <algorithm>

namespace plumb {

/// Sums over contacts [J].
struct ContactWork {
    double beyond = 0;     ///< λ (u − p)
    double of_change = 0;  ///< λ Δu / 2, never negative over all contacts of an island

    /// The greatest share of all impulses, at most 1, that adds no more energy than is asked for:
    /// velocities change in proportion.
    double share() const {
        if (!(beyond + of_change > 0) || !(of_change > 0)) return 1;
        return std::clamp(-beyond / of_change, 0.0, 1.0);
    }
};

/// Adds that of one contact. `push_out`: how the substep pushes old overlap out; h [s].
template <class Real, int W>
void add_work(ContactWork& work, const ContactArrays<Real, W>& rows, const ContactPlace& at,
              const BodyRows<Real>& bodies, const PushOut& push_out, double h) {
    const NormalRow<Real, W>& row = rows.normals[at.row];
    const ContactSides<Real> sides = sides_of(rows, at);
    const RowImpulse p = impulse_of(rows, at.row, at.lane);
    const Vector3d change = change_between(bodies, sides).template cast<double>();
    const Vector3d normal = sides.normal.template cast<double>();

    const double bounce = double(row.restitution_velocity[at.lane]);
    const double overlap = std::clamp(-double(row.gap[at.lane]), 0.0, push_out.most);
    const double u = double(row.velocity[at.lane]);
    const double wanted = bounce > 0 ? bounce : push_out.share * overlap / h;
    const double asked = u < wanted ? std::max(0.0, (u + wanted) / 2) : wanted;
    work.beyond += p.normal * (u - asked);
    work.of_change += 0.5 * p.normal * normal.dot(change);
    if (rows.frictions) {  // whose velocities are those against what anchors ask for
        const FrictionRow<Real, W>& across = rows.frictions[at.row];
        work.beyond += p.x * double(across.velocity_x[at.lane]) +
                       p.y * double(across.velocity_y[at.lane]);
        work.of_change += 0.5 * p.friction().dot(change);
    }
    if (!rows.rollings) return;
    const RollingRow<Real, W>& rolling = rows.rollings[at.row];
    const Vector3d torque(double(rolling.torque_x[at.lane]), double(rolling.torque_y[at.lane]),
                          double(rolling.torque_n[at.lane]));
    const Vector3d rate(double(rolling.rate_x[at.lane]), double(rolling.rate_y[at.lane]),
                        double(rolling.rate_n[at.lane]));
    const Vector3d turned = turn_between(bodies, sides).template cast<double>();
    work.beyond += torque.dot(rate);
    work.of_change += 0.5 * (torque.x() * p.tangents.x.dot(turned) +
                             torque.y() * p.tangents.y.dot(turned) + torque.z() * normal.dot(turned));
}

}  // namespace plumb
