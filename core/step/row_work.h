// SPDX-License-Identifier: MIT
/// The work of the impulses in contact rows: contacts/contact_work.h.
#pragma once

#include "constraints/contact.h"
#include "contacts/contact_work.h"
#include "schedule/contact_batches.h"
#include "solve/contact_iteration.h"
#include "step/contact_impulses.h"
#include "step/contact_sides.h"

#include <algorithm>

namespace plumb {

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
    work.at_start += p.normal * u;
    if (bounce > 0)
        work.at_start -= p.normal * granted_speed(u, bounce);
    else
        work.granted += p.normal * granted_speed(u, push_out.share * overlap / h);
    work.of_change += 0.5 * p.normal * normal.dot(change);
    if (rows.frictions) {  // whose velocities are those against what anchors ask for
        const FrictionRow<Real, W>& across = rows.frictions[at.row];
        work.at_start +=
            p.x * double(across.velocity_x[at.lane]) + p.y * double(across.velocity_y[at.lane]);
        work.of_change += 0.5 * p.friction().dot(change);
    }
    if (!rows.rollings) return;
    const RollingRow<Real, W>& rolling = rows.rollings[at.row];
    const Vector3d torque(double(rolling.torque_x[at.lane]), double(rolling.torque_y[at.lane]),
                          double(rolling.torque_n[at.lane]));
    const Vector3d rate(double(rolling.rate_x[at.lane]), double(rolling.rate_y[at.lane]),
                        double(rolling.rate_n[at.lane]));
    const Vector3d turned = turn_between(bodies, sides).template cast<double>();
    work.at_start += torque.dot(rate);
    work.of_change +=
        0.5 * (torque.x() * p.tangents.x.dot(turned) + torque.y() * p.tangents.y.dot(turned) +
               torque.z() * normal.dot(turned));
}

}  // namespace plumb
