// SPDX-License-Identifier: MIT
/// One contact taken out of its rows: the bodies that it acts on, and how they move there.
#pragma once

#include "constraints/connector.h"
#include "schedule/contact_batches.h"
#include "solve/velocity_table.h"

namespace plumb {

/// A body of a pair, and a contact's point on it.
template <class Real>
struct ContactSide {
    std::int32_t row;
    InverseMass<Real> mass;
    Vector3<Real> arm;
};
template <class Real>
struct ContactSides {
    ContactSide<Real> a, b;
    Vector3<Real> normal;
};

template <class Real, int W>
Vector3<Real> lane_of(const Real (&x)[3][W], std::uint32_t lane) {
    return {x[0][lane], x[1][lane], x[2][lane]};
}
template <class Real, int W>
Symmetric3<Real> lane_of(const Real (&x)[6][W], std::uint32_t lane) {
    return {x[0][lane], x[1][lane], x[2][lane], x[3][lane], x[4][lane], x[5][lane]};
}

template <class Real, int W>
ContactSides<Real> sides_of(const ContactArrays<Real, W>& rows, const ContactPlace& at) {
    const PairBlock<Real, W>& block = rows.blocks[at.block];
    const NormalRow<Real, W>& row = rows.normals[at.row];
    const std::uint32_t lane = at.lane;
    return {{block.row_a[lane],
             {block.inverse_mass_a[lane], lane_of(block.inverse_inertia_a, lane)},
             lane_of(row.arm_a, lane)},
            {block.row_b[lane],
             {block.inverse_mass_b[lane], lane_of(block.inverse_inertia_b, lane)},
             lane_of(row.arm_b, lane)},
            lane_of(row.normal, lane)};
}

/// How the velocity of a's point against b's has changed since the start of the substep [m/s].
template <class Real>
Vector3<Real> change_between(const BodyRows<Real>& bodies, const ContactSides<Real>& sides) {
    const auto change = [&](const ContactSide<Real>& side) {
        return velocity_at<Real>(velocity_in(bodies.change, side.row), side.arm);
    };
    return change(sides.a) - change(sides.b);
}

/// The same of the bodies' angular velocities [rad/s].
template <class Real>
Vector3<Real> turn_between(const BodyRows<Real>& bodies, const ContactSides<Real>& sides) {
    return velocity_in(bodies.change, sides.a.row).w - velocity_in(bodies.change, sides.b.row).w;
}

}  // namespace plumb
