// SPDX-License-Identifier: MIT
#pragma once

#include "constraints/effective_mass.h"
#include "ties/driven_axes.h"
#include "ties/joint_geometry.h"
#include "ties/joint_state.h"
#include "world/tie.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

/// Whether a script moves a body, with whatever energy that takes.
inline bool moves_by_itself(const Bodies& b, std::uint32_t body) {
    return body != kNoIndex && b.motion[body] == Motion::kinematic &&
           !(b.velocity[body].isZero(0) && b.angular_velocity[body].isZero(0));
}

/// Whether something limits a joint's axes.
inline bool has_limits(const World& world, std::uint32_t joint) {
    bool has = false;
    each_driven_axis(world.joints, joint, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i)
            has |= world.joints.drives[i].kind == DriveKind::limit;
    });
    return has;
}

/// Whether a tie may give its bodies energy: motors, springs and what is compliant do, and a
/// coupling that comes to a far offset, or that limits may keep from where it belongs.
inline bool can_do_work(const World& world, const Tie& tie) {
    if (tie.kind == TieKind::coupling) {
        const JointCoupling& c = world.joints.couplings[tie.index];
        return c.deferred != 0 || has_limits(world, c.joint_a) || has_limits(world, c.joint_b);
    }
    if (tie.kind == TieKind::link) return world.links[tie.index].compliance > 0;
    const Joint& joint = world.joints.joints[tie.index];
    bool can = joint.compliance > 0 || joint.angular_compliance > 0;
    each_driven_axis(world.joints, tie.index, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            const DriveKind kind = world.joints.drives[i].kind;
            can |= kind == DriveKind::motor || kind == DriveKind::spring;
        }
    });
    return can;
}

/// The most that what drives a joint can give its bodies in a substep of h [s]: a spring all that
/// it holds, a motor its greatest impulse at the greatest speed that the axis can have by it
/// [J]. Infinite, where nothing bounds it.
inline double most_work(const World& world, std::uint32_t index, double h) {
    const Joint& joint = world.joints.joints[index];
    if (joint.compliance > 0 || joint.angular_compliance > 0)
        return std::numeric_limits<double>::infinity();
    double work = 0;
    each_driven_axis(world.joints, index, [&](std::uint32_t first, std::uint32_t last) {
        double impulse = 0, fastest = std::numeric_limits<double>::infinity();
        const JointCoordinate q = joint_coordinate(world, index, world.joints.drives[first].axis);
        for (std::uint32_t i = first; i < last; ++i) {
            const JointDrive& drive = world.joints.drives[i];
            const JointAxisSpec& spec = drive.spec;
            if (drive.kind == DriveKind::motor) impulse = h * spec.motor.greatest;
            if (drive.kind == DriveKind::speed) fastest = spec.greatest_speed;
            if (drive.kind == DriveKind::spring)
                work += 0.5 * spec.stiffness * (q.value - spec.rest) * (q.value - spec.rest);
        }
        if (!(impulse > 0)) return;
        const double rate = std::abs(joint_rate(world.bodies, joint, q)),
                     gained = impulse * row_response(q, inverse_mass(world.bodies, joint.a),
                                                     inverse_mass(world.bodies, joint.b));
        work += impulse * std::max(rate, std::min(rate + gained, fastest));
    });
    return work;
}

}  // namespace plumb
