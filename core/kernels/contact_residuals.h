// SPDX-License-Identifier: MIT
/// The loop that finds the residuals of contact rows (effects/residual.h) at the velocities that
/// iterations have left. Included by the units of each instruction set and by nothing else.
#pragma once

#include "kernels/contact_passes.h"

namespace plumb::kernels {

/// What one more solution of a row alone would change, in squares.
template <class T>
struct RowResidual {
    T impulse;  ///< [N² s²]
    T error;    ///< of the velocity [m²/s²]
};

/// Along the normal; u is the velocity there now.
template <class Real, int W, class T = Number<Real, W>>
inline RowResidual<T> normal_residual(const NormalRow<Real, W>& row, const PassSettings<Real>& pass,
                                      const T& u) {
    const T mass = load(row.effective_mass);
    const T least = pass.shared_push ? -load(row.lambda_velocity) : T(0);
    T lambda = load(row.lambda_position);
    const T change =
        push<T>(lambda, -remaining_gap<Real, W>(row, pass, u) * (mass * T(pass.inverse_h)), least);
    const T speed = change * inverse_or_zero<T>(mass);
    return {change * change, speed * speed};
}

/// Across the normal; u is the velocity of a's point against b's, changed since the start of the
/// substep. What slides may slip: its error is what the least mass makes of the impulse that it
/// lacks.
template <class Real, int W, class T = Number<Real, W>>
inline RowResidual<T> friction_residual(const FrictionRow<Real, W>& row,
                                        const NormalRow<Real, W>& normal, const Vector3<T>& n,
                                        const PassSettings<Real>& pass, const Vector3<T>& u) {
    const Tangents<T> t = load_tangents(row, n);
    const Planar<T> velocity{load(row.velocity_x) + dot<T>(t.x, u),
                             load(row.velocity_y) + dot<T>(t.y, u)};
    const TangentMass<T> mass{load(row.mass_xx), load(row.mass_xy), load(row.mass_yy),
                              load(row.mass_least)};
    Planar<T> lambda{load(row.lambda_position_x), load(row.lambda_position_y)};
    Planar<T> other{T(0), T(0)};
    T push = load(normal.lambda_position);
    if (pass.shared_cone) {
        other = {load(row.lambda_velocity_x), load(row.lambda_velocity_y)};
        push += load(normal.lambda_velocity);
    }
    const Planar<T> change =
        solve_friction<T>(lambda, other, velocity, mass, T(load(row.friction) * push));
    const T squared = change.x * change.x + change.y * change.y,
            least = inverse_or_zero(mass.least);
    const T slip = velocity.x * velocity.x + velocity.y * velocity.y;
    return {squared, min(slip, squared * (least * least))};
}

template <class Real, int W, ContactVariant V>
void find_residuals(PairResidual<Real, W>* residuals, const ContactArrays<Real, W>& arrays,
                    const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                    std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    for (std::uint32_t i = first; i < last; ++i) {
        const PairBlock<Real, W>& block = arrays.blocks[i];
        const PairVelocity<T> pair = read_pair<Real, W>(bodies.change, block);
        T worst(0), sum(0), error(0), pushed(0);
        for (std::uint32_t k = block.first_row; k < block.first_row + block.row_count; ++k) {
            const NormalRow<Real, W>& row = arrays.normals[k];
            const Vector3<T> n = load_vector(row.normal);
            const Vector3<T> u = velocity_at<T>(pair.a, load_vector(row.arm_a)) -
                                 velocity_at<T>(pair.b, load_vector(row.arm_b));
            RowResidual<T> r =
                normal_residual<Real, W>(row, pass, load(row.velocity) + dot<T>(n, u));
            if constexpr (V != ContactVariant::frictionless) {
                const RowResidual<T> across =
                    friction_residual<Real, W>(arrays.frictions[k], row, n, pass, u);
                r = {r.impulse + across.impulse, max(r.error, across.error)};
            }
            worst = max(worst, r.impulse), error = max(error, r.error);
            sum += r.impulse;
            pushed += load(row.lambda_velocity) + load(row.lambda_position);
        }
        store(residuals[i].worst, worst), store(residuals[i].sum, sum);
        store(residuals[i].error, error), store(residuals[i].push, pushed);
    }
}

}  // namespace plumb::kernels
