// SPDX-License-Identifier: MIT
/// A coupling (gear, rack, mimic) at the start of a substep: C = q_b − ratio q_a − offset = 0, with
/// up to four bodies.
///
/// What the motion has added to C goes in one substep, so that a gear holds. More than a few
/// substeps can have added, such as an offset far from where the joints stand, is deferred and goes
/// at Settings::recovery_speed.
#pragma once

#include "ties/joint_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace plumb {

/// What one body's velocity (v, ω) adds to the rate of the row: along · v + turn · ω.
struct CouplingSide {
    std::uint32_t body = kNoIndex;
    Vector3d along = Vector3d::Zero(), turn = Vector3d::Zero();
};

struct CouplingRow {
    std::array<CouplingSide, 4> sides;
    std::uint32_t count = 0;
    double bias = 0;      ///< the rate shall be −bias [m/s], [rad/s]
    double deferred = 0;  ///< of C [m], [rad]

    /// A body that stands on both sides, as the frame that carries two wheels does, has one entry.
    void add(const World& world, std::uint32_t body, const Vector3d& along, const Vector3d& turn) {
        if (body == kNoIndex || world.bodies.motion[body] == Motion::fixed) return;
        std::uint32_t i = 0;
        while (i < count && sides[i].body != body) ++i;
        if (i == count) ++count, sides[i].body = body;
        sides[i].along += along, sides[i].turn += turn;
    }

    /// J M⁻¹ Jᵀ [1/kg], [1/(kg m²)].
    double response(const Bodies& b) const {
        double k = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const CouplingSide& s = sides[i];
            k += b.inverse_mass[s.body] * s.along.squaredNorm() +
                 s.turn.dot(Vector3d(b.world_inverse_inertia[s.body] * s.turn));
        }
        return k;
    }
};

/// What iterations leave adds up over so many substeps at most.
inline constexpr double kMadeAtOnce = 4;

/// What is left of an error when so much of it is taken away.
inline double without(double error, double taken) {
    return error - std::clamp(error, -taken, taken);
}

inline CouplingRow coupling_row(const World& world, const JointCoupling& coupling, double h) {
    const Joint &of_a = world.joints.joints[coupling.joint_a],
                &of_b = world.joints.joints[coupling.joint_b];
    const JointCoordinate a = joint_coordinate(world, coupling.joint_a, coupling.axis_a),
                          b = joint_coordinate(world, coupling.joint_b, coupling.axis_b);
    CouplingRow row;
    const auto add = [&](const Joint& joint, const JointCoordinate& q, double factor) {
        row.add(world, joint.a, factor * q.along, factor * q.turn_a);
        row.add(world, joint.b, -factor * q.along, -factor * q.turn_b);
    };
    add(of_a, a, -coupling.ratio), add(of_b, b, 1);

    const double speed = std::abs(joint_rate(world.bodies, of_b, b)) +
                         std::abs(coupling.ratio * joint_rate(world.bodies, of_a, a));
    const double recovered = h * world.settings.recovery_speed;
    row.deferred = without(coupling.deferred, recovered);
    const double made = b.value - coupling.ratio * a.value - coupling.offset - row.deferred;
    const double excess = without(made, recovered + kMadeAtOnce * h * speed);
    row.deferred += excess;
    row.bias = (made - excess) / h;
    return row;
}

}  // namespace plumb
