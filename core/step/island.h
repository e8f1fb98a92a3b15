// SPDX-License-Identifier: MIT
/// One island as its solver sees it: the bodies that move, the points at which they touch one
/// another or what is immovable, and the rows of their joints. Double precision, whatever the rows
/// of sweeps have.
///
/// Six numbers describe what acts at a point: impulses along the normal and two tangents, then
/// torques about them, over the point's length ℓ; and velocities likewise, those of turning times ℓ
/// (constraints/contact_cone.h).
#pragma once

#include "constraints/axis_drive.h"
#include "constraints/contact_cone.h"
#include "math/symmetric.h"
#include "math/types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace plumb {

inline constexpr std::uint32_t kImmovable = ~0u;

/// Slip below this share of the island's speed is creep: it stays the solution of a convex problem,
/// and what creeps lifts by as much. So a velocity below it is asked for as 0, a gap of a tenth of
/// a micrometre at 10 ms: a heap whose contacts lift and are closed again never comes to rest.
inline constexpr double kCreep = 1e-4;

struct IslandBody {
    std::uint32_t body;  ///< in the world's tables
    double mass;
    Symmetric3<double> inertia, inverse_inertia;  ///< world frame
};

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

/// What a row does to one body of the island: (force, torque) of an impulse of 1. The body's motion
/// contributes on · (v, ω) to the row's rate.
struct RowSide {
    std::uint32_t body;
    Vector6d on;
};

/// A row that a joint, a link or a coupling takes away, or all that drives one axis of a joint
/// (constraints/axis_drive.h).
struct IslandRow {
    static constexpr std::uint32_t kMostSides = 4;  ///< two joints that are coupled

    std::array<RowSide, kMostSides> side;
    std::uint32_t count = 0;          ///< of sides
    double mass = 0;                  ///< effective [kg], [kg m²]
    double length = 1;                ///< that makes a velocity of the rate: 1, or [m]
    double moving = 0;                ///< rate of what is immovable and moves by itself
    double wanted = 0, softness = 0;  ///< of a row that is taken away: rate − wanted + softness λ
                                      ///< is 0 [m/s], [1/kg], or of turning
    bool is_rigid = false;  ///< what gives by its softness is an error
    double most = 0;  ///< more than such a row bears unless others contradict it [N s], [N m s]
    double lowest = -std::numeric_limits<double>::infinity();  ///< of λ: 0 where it only pushes
    double highest = std::numeric_limits<double>::infinity();  ///< 0 where it only pulls
    const AxisDrive* drive = nullptr;                          ///< else the force law of the axis
    double impulse = 0;                                        ///< λ [N s], [N m s]

    std::span<const RowSide> sides() const { return {side.data(), count}; }

    /// What is immovable has no side, and a body only one.
    void add_side(std::uint32_t body, const Vector6d& on) {
        if (body == kImmovable) return;
        for (std::uint32_t i = 0; i < count; ++i)
            if (side[i].body == body) {
                side[i].on += on;
                return;
            }
        side[count++] = {body, on};
    }

    bool is_one_sided() const { return lowest == 0 || highest == 0; }
};

/// What a solver reads and improves. Velocities are (v, ω) and follow the impulses.
struct Island {
    std::span<const IslandBody> bodies;
    std::span<Vector6d> velocity;  ///< [body]
    std::span<IslandPoint> points;
    std::span<IslandRow> rows;
};

/// What the island's bodies contribute to the rate of a row if they move by `v`.
inline double rate_of(const IslandRow& row, std::span<const Vector6d> v) {
    double rate = 0;
    for (const RowSide& side : row.sides()) rate += side.on.dot(v[side.body]);
    return rate;
}

/// Adds a row's impulse to the sums (force, torque) of its bodies.
inline void add_impulse(const IslandRow& row, double impulse, std::span<Vector6d> sums) {
    for (const RowSide& side : row.sides()) sums[side.body] += impulse * side.on;
}

/// The impulse by which a row that gives way by 1/stiffness answers a rate of the island's bodies,
/// and how that falls with the rate.
struct RowAnswer {
    double impulse, slope;
};

/// All that this depends on but the rate.
struct RowLaw {
    const AxisDrive* drive;
    double stiffness, moving;
    double impulse;         ///< λ₀
    double slope;           ///< between the bounds
    double wanted, yields;  ///< velocity, and by how much λ₀ falls short of it
    double lowest, highest;

    RowLaw(const IslandRow& row, double stiff)
        : drive(row.drive),
          stiffness(stiff),
          moving(row.moving),
          impulse(row.impulse),
          slope(stiff / (1 + stiff * row.softness)),
          wanted(row.wanted),
          yields(row.softness * row.impulse),
          lowest(std::max(row.lowest, -row.most)),
          highest(std::min(row.highest, row.most)) {}
};
inline RowAnswer answer_of(const RowLaw& row, double rate) {
    if (!row.drive) {
        const double impulse = row.impulse + row.slope * (row.wanted - rate - row.yields);
        const double within = std::clamp(impulse, row.lowest, row.highest);
        return {within, within == impulse ? row.slope : 0};
    }
    const double stiffness = row.stiffness;
    const AxisAnswer met = answer_of(*row.drive, rate + row.moving, row.impulse, 1 / stiffness);
    const double slope = met.is_step ? stiffness : met.slope / (1 + met.slope / stiffness);
    return {met.impulse, slope};
}
inline RowAnswer answer_of(const IslandRow& row, double rate, double stiffness) {
    return answer_of(RowLaw(row, stiffness), rate);
}

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

/// M⁻¹ times (force, torque).
inline Vector6d response(const IslandBody& body, const Vector6d& sum) {
    Vector6d v;
    v << sum.head<3>() / body.mass, body.inverse_inertia * Vector3d(sum.tail<3>());
    return v;
}
/// M times (v, ω).
inline Vector6d momentum(const IslandBody& body, const Vector6d& v) {
    Vector6d p;
    p << body.mass * v.head<3>(), body.inertia * Vector3d(v.tail<3>());
    return p;
}

/// Of bodies that move by `v` [J].
inline double kinetic_energy(std::span<const IslandBody> bodies, std::span<const Vector6d> v) {
    double twice = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) twice += v[i].dot(momentum(bodies[i], v[i]));
    return 0.5 * twice;
}

}  // namespace plumb
