// SPDX-License-Identifier: MIT
/// The kernels of bodies by themselves: forces and the gyroscopic term, and new poses.
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb {

/// Number of bodies side by side, in double precision, beside W lanes of the rows.
template <int W>
inline constexpr int kBodyLanes = W > 1 ? W / 2 : 1;

/// Columns of Bodies as plain numbers: vectors of 3, quaternions of 4 (x y z w), symmetric matrices
/// of 6.
struct BodyColumns {
    const double *inverse_mass, *inertia, *inverse_inertia, *force, *torque, *turn_change;
    double *position, *orientation, *velocity, *angular_velocity;
    double *angular_momentum, *world_inverse_inertia;
};

/// Those that joints begin a substep from.
struct BodyStates {
    const double *position, *orientation, *velocity, *angular_velocity;
    const double *inverse_mass, *inertia, *world_inverse_inertia;
    const double *angular_velocity_now, *angular_velocity_before;
};

/// The bodies that a kernel works on, no two the same.
struct BodyList {
    const std::uint32_t* bodies;
    std::size_t count;
};

struct BodyKernels {
    /// `push`: how long forces act [s], of a substep of length h [s].
    using Integrate = void (*)(const BodyColumns&, BodyList, const double (&gravity)[3], double h,
                               double push);
    using Move = void (*)(const BodyColumns&, BodyList, double h);

    Integrate integrate;             ///< without the gyroscopic term
    Integrate integrate_gyroscopic;  ///< with it, angular momentum kept
    Move move;
    Move move_gyroscopic;  ///< the angular momentum decides the rate that is left
};

/// `lanes`: 1, 4, 8 or 16, of those that this processor runs.
const BodyKernels& body_kernels(int lanes);

}  // namespace plumb
