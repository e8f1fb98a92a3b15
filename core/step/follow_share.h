// SPDX-License-Identifier: MIT
/// How far a joint's impulse follows one of its bodies in this substep, by the load of the one
/// before.
#pragma once

#include "constraints/joint_follow.h"
#include "world/world.h"

namespace plumb {

/// `arm`: of the joint on the body, in any frame [m]; `body` may be kNoIndex.
inline double follow_share(const World& world, const Joint& joint, std::uint32_t body,
                           const Vector3d& arm, double h) {
    if (body == kNoIndex || world.bodies.motion[body] != Motion::dynamic) return 0;
    const auto& r = joint.rows;
    return joint_follow<double>(Vector3d(r[0], r[1], r[2]).norm(),
                                Vector3d(r[3], r[4], r[5]).norm(), arm.norm(),
                                world.bodies.world_inverse_inertia[body],
                                h * world.bodies.angular_velocity[body].norm(), h);
}

}  // namespace plumb
