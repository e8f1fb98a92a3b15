// SPDX-License-Identifier: MIT
/// What a contact leaves for the next step: its impulse, and what its friction holds on to, the
/// points of both bodies that met when it began to stick.
#pragma once

#include "contacts/pair_poses.h"
#include "world/contacts.h"

namespace plumb {

/// Whether a contact sticks with these impulses along and, squared, across it [N s].
inline bool does_stick(double normal, double across_squared, double friction) {
    constexpr double kBelow = 1 - 1e-5;  // of its bound
    const double most = kBelow * friction * normal;
    return across_squared < most * most;
}

/// What a contact bore that no exact island solved, until the next step; nothing turns or disputes
/// it.
inline void remember_impulse(ContactMemory& memory, double normal, const Vector3d& friction) {
    memory.normal_impulse = normal;
    memory.friction_impulse = friction;
    memory.rolling_impulse.setZero();
    memory.sticks = memory.exact = false;
    memory.disputed = memory.settling = 0;
}

/// A contact begins to stick at `point`, with a slip behind it already [m].
inline void set_anchors(ContactMemory& memory, const PairPoses& poses, const Vector3d& point,
                        const Vector3d& slip) {
    memory.stick_a = poses.in_a(point + 0.5 * slip);
    memory.stick_b = poses.in_b(point - 0.5 * slip);
}

/// How far apart the points have come by now [m].
inline Vector3d anchor_slip_of(const PairPoses& poses, const ContactMemory& memory) {
    return poses.a_in_world(memory.stick_a) - poses.b_in_world(memory.stick_b);
}

}  // namespace plumb
