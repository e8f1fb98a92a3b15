// SPDX-License-Identifier: MIT
/// The rows of ties: what they take away of how their bodies move, and what drives it.
#pragma once

#include "constraints/axis_drive.h"
#include "ties/solved_body.h"

#include <algorithm>
#include <array>
#include <limits>

namespace plumb {

/// What a row does to one body of the system: (force, torque) of an impulse of 1. The body's motion
/// contributes on · (v, ω) to the row's rate.
struct RowSide {
    std::uint32_t body;
    Vector6d on;
};

/// A row that a joint, a link or a coupling takes away, or all that drives one axis of a joint
/// (constraints/axis_drive.h).
struct TieRow {
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

/// What the system's bodies contribute to the rate of a row if they move by `v`.
inline double rate_of(const TieRow& row, std::span<const Vector6d> v) {
    double rate = 0;
    for (const RowSide& side : row.sides()) rate += side.on.dot(v[side.body]);
    return rate;
}

/// Adds a row's impulse to the sums (force, torque) of its bodies.
inline void add_impulse(const TieRow& row, double impulse, std::span<Vector6d> sums) {
    for (const RowSide& side : row.sides()) sums[side.body] += impulse * side.on;
}

/// The impulse by which a row that gives way by 1/stiffness answers a rate of the system's bodies,
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

    RowLaw(const TieRow& row, double stiff)
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
inline RowAnswer answer_of(const TieRow& row, double rate, double stiffness) {
    return answer_of(RowLaw(row, stiffness), rate);
}

}  // namespace plumb
