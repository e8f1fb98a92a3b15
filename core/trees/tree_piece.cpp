// SPDX-License-Identifier: MIT
#include "trees/tree_piece.h"

#include "solve/free_turn.h"
#include "solve/rest_motion.h"
#include "trees/joint_closing.h"
#include "world/body_momentum.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace plumb {
namespace {

/// By which shares what flies is closed, one after the other, until its energy is enough for that.
constexpr double kShares[] = {1, 0.5, 0.25, 0.125};

/// What comes as near as this touches [m]; and rounds in which a piece is shifted off what it
/// touches, for walls may face each other.
constexpr double kTouch = 1e-3;
constexpr int kShiftRounds = 3;

/// What energies may be off by rounding.
constexpr double kRounding = 1e-12;

/// For what is asked about all bodies of a piece: calls visit(body, its velocity).
template <class Member>
auto each_of(const Bodies& b, const std::vector<Member>& members) {
    return [&](auto visit) {
        for (const Member& m : members)
            visit(m.body, Velocity<double>{b.velocity[m.body], b.angular_velocity[m.body]});
    };
}

}  // namespace

void TreePiece::add(const Bodies& b, std::uint32_t body, std::uint32_t joint) {
    const Pose pose{b.position[body], b.orientation[body]};
    members_.push_back({body, joint, pose, pose, {b.velocity[body], b.angular_velocity[body]}});
}

void TreePiece::close(World& world) {
    Bodies& b = world.bodies;
    const double energy = energy_against(b, motion_of_holder(world));
    const Vector3d momentum = angular_momentum(b);
    find_closed(world);
    if (!is_held()) shift_back(b);
    for (const double share : kShares) {
        take_poses(b, share);
        if (!is_held()) keep_momentum(b, momentum);
        if (keep_energy(world, energy)) return;
    }
    take_poses(b, 0);
}

void TreePiece::find_closed(World& world) {
    Bodies& b = world.bodies;
    for (Member& m : members_) {
        if (m.joint != kNoIndex) close_joint(b, world.joints.joints[m.joint], m.body);
        m.closed = {b.position[m.body], b.orientation[m.body]};
    }
}

bool TreePiece::touches() const {
    return std::any_of(obstacles_.begin(), obstacles_.end(),
                       [](const Obstacle& o) { return o.gap < kTouch; });
}

/// All that is closed to its place.
void TreePiece::shift_back(const Bodies& b) {
    double mass = 0;
    Vector3d moment = Vector3d::Zero();
    for (const Member& m : members_) {
        mass += b.mass[m.body];
        moment += b.mass[m.body] * (m.closed.position - m.open.position);
    }
    shift(-moment / mass);
    for (int round = 0; round < kShiftRounds; ++round)
        for (const Obstacle& o : obstacles_) {
            const Member& m = members_[o.member];
            const Quaterniond turn = m.closed.orientation * m.open.orientation.conjugate();
            const Vector3d moved = m.closed.position - m.open.position + (turn * o.arm - o.arm);
            const double deeper = std::min(o.gap, 0.0) - (o.gap + o.normal.dot(moved));
            if (deeper > 0) shift(deeper * o.normal);
        }
}

void TreePiece::shift(const Vector3d& by) {
    for (Member& m : members_) m.closed.position += by;
}

/// At a share of the way to where they are closed, with the velocities that they had: rates turn
/// with the bodies.
void TreePiece::take_poses(Bodies& b, double share) const {
    for (const Member& m : members_) {
        Quaterniond turn = m.closed.orientation * m.open.orientation.conjugate();
        turn.coeffs() *= turn.w() < 0 ? -share : share;
        turn.w() += 1 - share;
        turn.normalize();
        b.position[m.body] = m.open.position + share * (m.closed.position - m.open.position);
        b.orientation[m.body] = (turn * m.open.orientation).normalized();
        b.velocity[m.body] = m.velocity.v;
        b.angular_velocity[m.body] = turn * m.velocity.w;
    }
}

/// About the centre of mass [kg m²/s].
Vector3d TreePiece::angular_momentum(const Bodies& b) const {
    return FreeBodies(b, each_of(b, members_)).momentum;
}

void TreePiece::keep_momentum(Bodies& b, const Vector3d& before) const {
    const FreeBodies now(b, each_of(b, members_));
    const RigidMotion turn = now.turn_against(now.momentum - before);
    for (const Member& m : members_) {
        const Velocity<double> more = turn.of(b, m.body);
        b.velocity[m.body] += more.v, b.angular_velocity[m.body] += more.w;
    }
}

/// Returns whether it has no more than before [J].
bool TreePiece::keep_energy(World& world, double before) const {
    Bodies& b = world.bodies;
    const RigidMotion holder = motion_of_holder(world);
    const double gained = energy_against(b, holder) + lift(world) - before;
    if (gained <= kRounding * before) return true;
    const RigidMotion rest = is_held() ? holder : motion_as_one(b, each_of(b, members_));
    const double moving = energy_against(b, rest);
    if (gained < moving) {
        slow(b, rest, std::sqrt(1 - gained / moving));
        return true;
    }
    if (is_held() || !touches()) return false;
    slow(b, rest, 0);
    RigidMotion ahead = rest;
    ahead.motion.w.setZero();
    const double turning = energy_against(b, ahead);
    if (gained - moving > turning) return false;
    slow(b, ahead, turning > 0 ? std::sqrt(1 - (gained - moving) / turning) : 0);
    return true;
}

/// To a share of the velocities against a motion of all.
void TreePiece::slow(Bodies& b, const RigidMotion& against, double kept) const {
    for (const Member& m : members_) {
        const Velocity<double> of = against.of(b, m.body);
        Vector3d &v = b.velocity[m.body], &w = b.angular_velocity[m.body];
        v = of.v + kept * (v - of.v), w = of.w + kept * (w - of.w);
    }
}

/// Of the body by which the first hangs; of none: rest.
RigidMotion TreePiece::motion_of_holder(const World& world) const {
    if (!is_held()) return {};
    const Bodies& b = world.bodies;
    const Joint& joint = world.joints.joints[members_.front().joint];
    const std::uint32_t holder = joint.a == members_.front().body ? joint.b : joint.a;
    if (holder == kNoIndex) return {};
    return {b.position[holder], {b.velocity[holder], b.angular_velocity[holder]}};
}

/// Of how they move against such a motion [J].
double TreePiece::energy_against(const Bodies& b, const RigidMotion& motion) const {
    double energy = 0;
    for (const Member& m : members_) {
        const Velocity<double> of = motion.of(b, m.body);
        energy +=
            kinetic_energy(b, m.body, b.velocity[m.body] - of.v, b.angular_velocity[m.body] - of.w);
    }
    return energy;
}

/// What it takes to lift them from where they were open to where they are [J].
double TreePiece::lift(const World& world) const {
    const Bodies& b = world.bodies;
    double work = 0;
    for (const Member& m : members_)
        work -= b.mass[m.body] * world.settings.gravity.dot(b.position[m.body] - m.open.position);
    return work;
}

}  // namespace plumb
