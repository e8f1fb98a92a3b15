// SPDX-License-Identifier: MIT
/// One island as its solver sees it: the bodies that move, the points at which they touch one
/// another or what is immovable, and the rows of their joints. Double precision, whatever the rows
/// of sweeps have.
///
/// Six numbers describe what acts at a point: impulses along the normal and two tangents, then
/// torques about them, over the point's length ℓ; and velocities likewise, those of turning times ℓ
/// (constraints/contact_cone.h).
#pragma once

#include "constraints/contact_cone.h"
#include "ties/solved_body.h"
#include "ties/tie_row.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace plumb {

/// Slip below this share of the island's speed is creep: it stays the solution of a convex problem,
/// and what creeps lifts by as much. So a velocity below it is asked for as 0, a gap of a tenth of
/// a micrometre at 10 ms: a heap whose contacts lift and are closed again never comes to rest.
inline constexpr double kCreep = 1e-4;

struct IslandPoint {
    std::uint32_t a, b;     ///< bodies of the island, or kImmovable
    Matrix3d frame;         ///< columns: normal, out of b towards a, and two tangents
    Vector3d arm_a, arm_b;  ///< from the centres of mass to the point [m]
    double mass;            ///< least effective mass in any direction [kg]
    double mass_normal;     ///< effective mass along the normal [kg]
    double length;          ///< ℓ, from the least effective inertia: mass ℓ² [m]
    ContactCone cone;
    Vector6d wanted;   ///< velocities that the substep asks of the island's bodies [m/s]
    Vector6d impulse;  ///< [N s]
};

/// What a solver reads and improves. Velocities are (v, ω) and follow the impulses.
struct Island {
    std::span<const SolvedBody> bodies;
    std::span<Vector6d> velocity;  ///< [body]
    std::span<IslandPoint> points;
    std::span<TieRow> rows;
};

/// Velocities at a point, of bodies that move by `v`; those of turning are 0 where nothing resists
/// it, and left out with N = 3.
template <int N = 6>
inline ContactVector<N> velocity_of(const IslandPoint& p, std::span<const Vector6d> v) {
    Vector3d u = Vector3d::Zero(), w = u;
    if (p.a != kImmovable) {
        w += v[p.a].tail<3>();
        u += v[p.a].head<3>() + cross<double>(v[p.a].tail<3>(), p.arm_a);
    }
    if (p.b != kImmovable) {
        w -= v[p.b].tail<3>();
        u -= v[p.b].head<3>() + cross<double>(v[p.b].tail<3>(), p.arm_b);
    }
    ContactVector<N> all = ContactVector<N>::Zero();
    all.template head<3>() = p.frame.transpose() * u;
    if constexpr (N == 6)
        if (p.cone.turns()) all.template tail<3>() = p.length * (p.frame.transpose() * w);
    return all;
}

/// What friction bears at a point, on a, in the world's frame [N s].
inline Vector3d friction_of(const IslandPoint& p) {
    return p.frame.rightCols<2>() * p.impulse.segment<2>(1);
}

/// An impulse at a point as a force on a, and a torque beside that of its arm.
struct PointForce {
    Vector3d along, about;

    template <int N>
    PointForce(const IslandPoint& p, const Eigen::Matrix<double, N, 1>& impulse)
        : along(p.frame * impulse.template head<3>()), about(Vector3d::Zero()) {
        if constexpr (N == 6)
            if (p.cone.turns()) about = p.length * (p.frame * impulse.template tail<3>());
    }
};

/// Adds a point's impulse to the sums (force, torque) of its bodies.
template <int N>
inline void add_impulse(const IslandPoint& p, const Eigen::Matrix<double, N, 1>& impulse,
                        std::span<Vector6d> sums) {
    const PointForce force(p, impulse);
    if (p.a != kImmovable) {
        sums[p.a].head<3>() += force.along;
        sums[p.a].tail<3>() += cross<double>(p.arm_a, force.along) + force.about;
    }
    if (p.b != kImmovable) {
        sums[p.b].head<3>() -= force.along;
        sums[p.b].tail<3>() -= cross<double>(p.arm_b, force.along) + force.about;
    }
}

}  // namespace plumb
