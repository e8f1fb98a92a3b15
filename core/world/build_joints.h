// SPDX-License-Identifier: MIT
/// Joints and couplings, from what the user wrote to the tables.
#pragma once

#include "world/world.h"

#include <algorithm>
#include <string>
#include <vector>

namespace plumb {

/// Adds the scene's joints and couplings to a world that has its bodies. Throws SceneError, with a
/// JSON pointer, for what cannot be simulated.
void build_joints(World& world, const Scene& scene);

/// A joint that is not in the table yet.
struct JointDraft {
    Joint joint;
    std::vector<JointDrive> drives;
};

/// A joint between two bodies, given by their slots, where they are now. Throws SceneError, with
/// `pointer` as the joint's place.
JointDraft make_joint(const World& world, const JointSpec& spec, const std::string& pointer);

/// Joint::crowd of all joints; to be called when joints have come or gone.
void count_springs(World& world);

/// Leaves World::excluded to be sorted.
void append_joint(World& world, JointDraft draft);

/// A coupling of two joints, given by their indices. Throws SceneError, with `pointer` as the
/// coupling's place.
JointCoupling make_coupling(const World& world, const CouplingSpec& spec,
                            const std::string& pointer);
void append_coupling(World& world, JointCoupling coupling);

/// A joint's coordinates where it was made: 0, for the frames coincide, but of a distance [m].
inline double start_coordinate(const World& world, std::uint32_t joint) {
    const Joint& j = world.joints.joints[joint];
    return j.kind == JointKind::distance ? j.length : 0.0;
}

/// The pair_key of the bodies that a joint keeps apart.
inline std::uint64_t kept_apart(const Joint& joint) {
    return pair_key(std::min(joint.a, joint.b), std::max(joint.a, joint.b));
}

}  // namespace plumb
