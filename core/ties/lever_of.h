// SPDX-License-Identifier: MIT
/// How a joint's levers turn in this substep, by its load in the one before.
#pragma once

#include "constraints/joint_lever.h"
#include "constraints/joint_rows.h"
#include "world/world.h"

#include <algorithm>
#include <cmath>

namespace plumb {

/// How the joint is solved.
enum class JointSolve { tree, iterations };

/// What a joint bore along its axes (first: kAlongX) [N s] or about them (kTurnX) [N m s]: of those
/// that are iterated in both of the last two substeps, for what a blow leaves with them is no load.
inline double load_of(const Joint& joint, std::uint32_t first, JointSolve solve) {
    const auto size = [first](const auto& rows) {
        return Vector3d(rows[first], rows[first + 1], rows[first + 2]).norm();
    };
    if (solve == JointSolve::tree) return size(joint.rows);
    return std::min(size(joint.rows), size(joint.rows_before));
}

/// (h ω)² of a body under the moment M = λ u × w of its joint's rotational rows (constraints/
/// joint_lever.h). Where the body turns by δ, u does, too, and M changes by λ u (w · δ): it couples
/// turns about u with turns about w. Where the world holds the joint and leaves one turn free or
/// none, there is nothing to couple.
inline double angular_load(const World& world, const Joint& joint, std::uint32_t body, double h) {
    const Bodies& b = world.bodies;
    const auto moves = [&](std::uint32_t i) {
        return i != kNoIndex && b.motion[i] == Motion::dynamic;
    };
    const int locked = joint.locked[kTurnX] + joint.locked[kTurnY] + joint.locked[kTurnZ];
    if (locked >= 2 && !(moves(joint.a) && moves(joint.b))) return 0;
    const Symmetric3<double>& inverse = b.world_inverse_inertia[body];
    double load = 0;
    for (int k = 0; k < 3; ++k) {
        if (!joint.locked[kTurnX + k] || joint.rows[kTurnX + k] == 0) continue;
        const Vector3d u = b.orientation[joint.a] * joint.turns[k].u;
        Vector3d w = joint.turns[k].w;
        if (joint.b != kNoIndex) w = b.orientation[joint.b] * w;
        load += std::abs(joint.rows[kTurnX + k]) *
                std::sqrt(dot(u, Vector3d(inverse * u)) * dot(w, Vector3d(inverse * w)));
    }
    return h * load;
}

/// (h ω)² of a body in a tree under all that its joint bears; `arm`: of the joint on the body,
/// world frame [m].
inline double tree_load(const World& world, const Joint& joint, std::uint32_t body,
                        const Vector3d& arm, double h) {
    return lever_load<double>(load_of(joint, kAlongX, JointSolve::tree), 0, arm,
                              world.bodies.world_inverse_inertia[body], h) +
           angular_load(world, joint, body, h);
}

/// `arm`: of the joint on the body, world frame [m]; `body` may be kNoIndex.
inline JointLever<double> lever_of(const World& world, const Joint& joint, std::uint32_t body,
                                   const Vector3d& arm, JointSolve solve, double h) {
    if (body == kNoIndex || world.bodies.motion[body] != Motion::dynamic)
        return {0, Vector3d::Zero()};
    const Bodies& b = world.bodies;
    const Vector3d turn = h * b.angular_velocity_now[body];
    if (solve == JointSolve::iterations) {
        const double load =
            lever_load<double>(load_of(joint, kAlongX, solve), load_of(joint, kTurnX, solve), arm,
                               b.world_inverse_inertia[body], h);
        return iterated_lever<double>(load, turn);
    }
    return exact_lever<double>(tree_load(world, joint, body, arm, h),
                               swing_squared<double>(turn, arm), turn,
                               [&]() -> Vector3d { return h * b.angular_velocity_before[body]; });
}

/// The same for the line of a distance joint, whose pull turns with it; that of one that is
/// iterated is where the points are at the end.
inline void turn_line(JointGeometry<double>& g, const World& world, const Joint& joint,
                      JointSolve solve, double h) {
    g.line_share = 1, g.line_lag = Vector3d::Zero();
    if (solve == JointSolve::iterations) return;
    const Bodies& b = world.bodies;
    double response = 0;  // of the points, in any direction [1/kg]
    Vector3d moved = Vector3d::Zero(), moved_before = Vector3d::Zero();
    const auto add = [&](std::uint32_t body, const Vector3d& arm, double sign) {
        if (body == kNoIndex) return;
        const Symmetric3<double> k =
            point_response<double>({b.inverse_mass[body], b.world_inverse_inertia[body]}, arm);
        response += std::max({k.xx, k.yy, k.zz});
        moved += sign * h * (b.velocity_now[body] + b.angular_velocity_now[body].cross(arm));
        moved_before +=
            sign * h * (b.velocity_before[body] + b.angular_velocity_before[body].cross(arm));
    };
    add(joint.a, g.r_a, 1), add(joint.b, g.r_b, -1);
    const double load = h * load_of(joint, kAlongX, solve) * response / joint.length;
    const Vector3d turn = moved / joint.length;
    const JointLever<double> line = exact_lever<double>(
        load, turn.squaredNorm(), turn, [&]() -> Vector3d { return moved_before / joint.length; });
    g.line_share = line.share, g.line_lag = line.lag * joint.length;
}

}  // namespace plumb
