// SPDX-License-Identifier: MIT
#include "ties/tie_list.h"

#include <algorithm>
#include <tuple>

namespace plumb {

void TieList::find(const World& world) {
    ties_.clear(), rows_.clear();
    const auto add = [&](TieKind kind, std::uint32_t i, std::uint32_t a, std::uint32_t b) {
        if (!holds(world, {kind, i})) return;
        ties_.push_back({kind, i});
        rows_.push_back({world.row_of(a), world.row_of(b), i, 1});
    };
    const std::vector<Joint>& joints = world.joints.joints;
    for (std::uint32_t i = 0; i < joints.size(); ++i)
        add(TieKind::joint, i, joints[i].a, joints[i].b);
    first_seed_ = move_loops_back(world);
    for (std::uint32_t i = 0; i < world.links.size(); ++i) {
        const Link& link = world.links[i];
        if (link.is_between_bodies()) add(TieKind::link, i, link.a.body, link.b.body);
    }
    // two trees of joints become one
    const auto mover = [&](const Joint& joint) {
        const bool moves = joint.b == kNoIndex || world.bodies.motion[joint.a] == Motion::dynamic;
        return moves ? joint.a : joint.b;
    };
    for (std::uint32_t i = 0; i < world.joints.couplings.size(); ++i) {
        const JointCoupling& c = world.joints.couplings[i];
        add(TieKind::coupling, i, mover(joints[c.joint_a]), mover(joints[c.joint_b]));
    }
}

/// Moves the joints behind the others that close loops, or that hold nothing but by what drives
/// them, as ropes do, which are no part of trees; returns where they begin.
std::size_t TieList::move_loops_back(const World& world) {
    ground_ = world.dynamic_count;
    joined_.reset(static_cast<std::size_t>(ground_) + 1);
    loops_.clear();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ties_.size(); ++i) {
        const Joint& joint = world.joints.joints[ties_[i].index];
        if (joint.locked == decltype(joint.locked){} || closes_loop(rows_[i])) {
            loops_.emplace_back(ties_[i], rows_[i]);
            continue;
        }
        ties_[kept] = ties_[i], rows_[kept++] = rows_[i];
    }
    for (std::size_t i = 0; i < loops_.size(); ++i)
        std::tie(ties_[kept + i], rows_[kept + i]) = loops_[i];
    return kept;
}

/// Called for one joint after another: whether those before tie its bodies together already. What
/// is immovable is one body.
bool TieList::closes_loop(const BodyPair& joint) {
    const auto set = [this](std::int32_t row) {
        return joined_.lowest(static_cast<std::uint32_t>(std::min(row, ground_)));
    };
    const std::uint32_t a = set(joint.row_a), b = set(joint.row_b);
    joined_.unite(a, b);
    return a == b;
}

}  // namespace plumb
