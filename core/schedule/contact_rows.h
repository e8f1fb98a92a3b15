// SPDX-License-Identifier: MIT
/// Memory of the contact solver: W pairs of bodies side by side, and a row for each of their
/// points.
///
/// Lane i of a block is one pair of bodies; row k of the block holds the k-th point of each pair.
/// Lanes without a pair, and rows beyond a pair's last point, are zero and therefore push nothing.
/// Tangents exist in memory only where a scene has friction, rolling rows only where it has rolling
/// or spinning friction.
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb {

template <class Real, int W>
inline constexpr std::size_t kRowAlignment = sizeof(Real) * W < 64 ? sizeof(Real) * W : 64;

/// The bodies of W pairs.
template <class Real, int W>
struct alignas(64) PairBlock {
    Real inverse_mass_a[W], inverse_mass_b[W];              // [1/kg]
    Real inverse_inertia_a[6][W], inverse_inertia_b[6][W];  // xx yy zz xy xz yz, world frame
    std::int32_t row_a[W], row_b[W];                        // row of the body in the velocity table
    std::uint32_t first_row, row_count;
};

/// Along the normal.
template <class Real, int W>
struct alignas(kRowAlignment<Real, W>) NormalRow {
    Real normal[3][W];
    Real arm_a[3][W], arm_b[3][W];  // from the centre of mass to the common point [m]
    Real effective_mass[W];         // 1 / (nᵀ K n) [kg]
    Real gap[W];                    // at the start of the substep [m]
    Real restitution_velocity[W];   // separating speed that restitution asks for [m/s], 0 = none
    Real velocity[W];               // along n, at the start of the substep, forces included [m/s]
    Real lambda_velocity[W], lambda_position[W];  // summed impulses of the two passes [N s]
};

/// Across the normal.
template <class Real, int W>
struct alignas(kRowAlignment<Real, W>) FrictionRow {
    Real tangent[3][W];                       // t₁; t₂ = n × t₁
    Real mass_xx[W], mass_xy[W], mass_yy[W];  // inverse of the tangents' K [kg]
    Real mass_least[W];                       // 1 / greatest eigenvalue of K [kg]
    Real coupling_x[W], coupling_y[W];        // t₁ᵀ K n, t₂ᵀ K n [1/kg]
    Real friction[W];                         // μ
    Real anchor_velocity_x[W],
        anchor_velocity_y[W];           // that brings a sticking contact back to its anchors [m/s]
    Real velocity_x[W], velocity_y[W];  // at the start of the substep, forces included [m/s]
    Real lambda_velocity_x[W], lambda_velocity_y[W];  // summed impulse of the velocity pass [N s]
    Real lambda_position_x[W], lambda_position_y[W];  // summed impulse of the position pass [N s]
};

/// Against rolling and spinning.
template <class Real, int W>
struct alignas(kRowAlignment<Real, W>) RollingRow {
    Real rolling[W], spinning[W];  // levers ρ, σ [m]
    Real inertia_xx[W], inertia_xy[W],
        inertia_yy[W];                     // inverse of the tangents' response to torque [kg m²]
    Real inertia_least[W];                 // 1 / greatest eigenvalue of that response [kg m²]
    Real inertia_n[W];                     // effective inertia about n [kg m²]
    Real rate_x[W], rate_y[W], rate_n[W];  // at the start of the substep [rad/s]
    Real torque_x[W], torque_y[W], torque_n[W];  // summed torque impulses of both passes [N m s]
};

/// Which kinds of rows a batch carries.
enum class ContactVariant : std::uint32_t { frictionless, friction, rolling };
inline constexpr int kContactVariants = 3;

/// The arrays of all blocks, as plain pointers: what crosses the border to a kernel.
template <class Real, int W>
struct ContactArrays {
    PairBlock<Real, W>* blocks;
    NormalRow<Real, W>* normals;
    FrictionRow<Real, W>* frictions;  // nullptr when frictionless
    RollingRow<Real, W>* rollings;    // nullptr when nothing resists rolling or spinning
};

/// One body in the velocity table: v, 0, ω, 0.
inline constexpr int kBodyRowSize = 8;

/// Velocities by row: dynamic bodies first, then particles, then kinematic bodies, then one row of
/// zeros for all that is fixed.
template <class Real>
struct BodyRows {
    Real* change;       // since the start of the substep; only the first dynamic_count rows do
    const Real* start;  // at the start of the substep, forces included
    std::int32_t dynamic_count;     // of bodies and particles
    const Real* preview = nullptr;  // particles: where `start` takes them, against one point of the
                                    // world [m]; elements 4 to 6 are what rounding takes off 0 to 2
};

/// What a pass needs to know besides the rows.
template <class Real>
struct PassSettings {
    Real h, inverse_h;  // substep [s] and its inverse [1/s]
    Real stiffness;     // s of this substep
    Real recovery;      // overlap beyond which no more is pushed out in a substep [m]
    bool warm_start;    // begin with the impulses of the substep before
    bool shared_cone;   // one friction bound for both passes
    bool shared_push;   // the push of both passes together stays repulsive, not of each alone
    bool forwards;      // direction of this iteration
    std::uint32_t iteration = 0;          // of the pass
    std::uint32_t round = 0, rounds = 1;  // of the iteration, which goes over all so many times
    bool alone = false;                   // nothing but one group changes velocities in this pass
};

}  // namespace plumb
