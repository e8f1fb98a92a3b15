// SPDX-License-Identifier: MIT
#include "islands/driven_islands.h"

#include "constraints/substep_time.h"
#include "ties/tie_work.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// A motor is boundless that lifts so many times the weight of the bodies that it drives.
constexpr double kBoundless = 3e4;

/// Whether nothing that weighs as much as a motor's own bodies can stop it.
bool is_boundless(const World& world, const JointDrive& drive) {
    const JointMotor& motor = drive.spec.motor;
    if (drive.kind != DriveKind::motor || motor.mode != MotorMode::velocity) return false;
    if (!std::isfinite(motor.greatest)) return true;
    const Bodies& b = world.bodies;
    const Joint& joint = world.joints.joints[drive.joint];
    double weight = 0, lever = drive.axis < kTurnX ? 1 : 0;
    for (const std::uint32_t body : {joint.a, joint.b}) {
        if (body == kNoIndex || b.motion[body] != Motion::dynamic) continue;
        weight += b.mass[body] * pull_on(world, body);
        if (drive.axis >= kTurnX) lever = std::max(lever, b.bounding_radius[body]);
    }
    return weight * lever > 0 && motor.greatest > kBoundless * weight * lever;
}

}  // namespace

void DrivenIslands::find(const World& world, const std::vector<BodyPair>& pairs,
                         const std::vector<Tie>& ties, const ContactIslands& found) {
    driven_.assign(static_cast<std::size_t>(world.dynamic_count), 0);
    boundless_.clear();
    for (const JointDrive& drive : world.joints.drives)
        if (is_boundless(world, drive)) boundless_.push_back(drive.joint);
    if (world.kinematic_count == 0 && boundless_.empty()) return;
    const Bodies& b = world.bodies;
    const auto moves = [&](std::uint32_t body) { return moves_by_itself(b, body); };
    const auto touches = [&](std::uint32_t pair) {
        const Contact& c = world.contacts.found[pairs[pair].first];
        return moves(c.a) || moves(c.b);
    };
    const auto pulls = [&](std::uint32_t i) {
        bool any = ties[i].kind == TieKind::joint &&
                   std::binary_search(boundless_.begin(), boundless_.end(), ties[i].index);
        each_body(world, ties[i], [&](std::uint32_t body) { any |= moves(body); });
        return any;
    };
    for (const ContactIsland& island : found.islands()) {
        const auto pair = found.pairs().begin();
        const auto tie = found.ties().begin();
        if (std::none_of(pair + island.first_pair, pair + island.last_pair, touches) &&
            std::none_of(tie + island.first_tie, tie + island.last_tie, pulls))
            continue;
        for (std::uint32_t i = island.first_body; i < island.last_body; ++i)
            driven_[static_cast<std::size_t>(found.bodies()[i])] = 1;
    }
}

}  // namespace plumb
