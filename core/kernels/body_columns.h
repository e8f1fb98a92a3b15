// SPDX-License-Identifier: MIT
/// The bodies' columns as the kernels see them.
#pragma once

#include "kernels/body_kernels.h"
#include "world/bodies.h"

namespace plumb {

template <class Item>
double* numbers(std::vector<Item>& column) {
    return reinterpret_cast<double*>(column.data());
}
template <class Item>
const double* numbers(const std::vector<Item>& column) {
    return reinterpret_cast<const double*>(column.data());
}
static_assert(sizeof(Vector3d) == 3 * sizeof(double));
static_assert(sizeof(Quaterniond) == 4 * sizeof(double));
static_assert(sizeof(Symmetric3<double>) == 6 * sizeof(double));

inline BodyColumns columns_of(Bodies& b) {
    return {b.inverse_mass.data(),       numbers(b.inertia),
            numbers(b.inverse_inertia),  numbers(b.force),
            numbers(b.torque),           numbers(b.turn_change),
            numbers(b.position),         numbers(b.orientation),
            numbers(b.velocity),         numbers(b.angular_velocity),
            numbers(b.angular_momentum), numbers(b.world_inverse_inertia)};
}

inline BodyStates states_of(const Bodies& b) {
    return {numbers(b.position),
            numbers(b.orientation),
            numbers(b.velocity),
            numbers(b.angular_velocity),
            b.inverse_mass.data(),
            numbers(b.inertia),
            numbers(b.world_inverse_inertia),
            numbers(b.angular_velocity_now),
            numbers(b.angular_velocity_before)};
}

}  // namespace plumb
