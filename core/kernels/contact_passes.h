// SPDX-License-Identifier: MIT
/// The loops behind the contact kernels. Included by the units of each instruction set, through
/// kernels/contact_tables.h, and by nothing else.
///
/// A block's bodies are gathered once, its points are solved one after another, and the bodies are
/// written back.
#pragma once

#include "constraints/contact.h"
#include "constraints/friction.h"
#include "constraints/rolling.h"
#include "kernels/contact_kernels.h"
#include "kernels/gather.h"
#include "kernels/inverse.h"

namespace plumb::kernels {

template <class T>
struct PairVelocity {
    Velocity<T> a, b;
};
template <class T>
struct PairMass {
    InverseMass<T> a, b;
};

template <class Real, int W, class T = Number<Real, W>>
inline Symmetric3<T> load_symmetric(const Real (&m)[6][W]) {
    return {load(m[0]), load(m[1]), load(m[2]), load(m[3]), load(m[4]), load(m[5])};
}

template <class Real, int W, class T = Number<Real, W>>
inline PairMass<T> load_masses(const PairBlock<Real, W>& block) {
    return {{load(block.inverse_mass_a), load_symmetric(block.inverse_inertia_a)},
            {load(block.inverse_mass_b), load_symmetric(block.inverse_inertia_b)}};
}

template <class Real, int W, class T = Number<Real, W>>
inline PairVelocity<T> read_pair(const Real* rows, const PairBlock<Real, W>& block) {
    return {read_velocities<Real, W>(rows, block.row_a),
            read_velocities<Real, W>(rows, block.row_b)};
}

template <class Real, int W, class T = Number<Real, W>>
inline void write_pair(const BodyRows<Real>& bodies, const PairBlock<Real, W>& block,
                       const PairVelocity<T>& pair) {
    write_velocities<Real, W>(bodies.change, block.row_a, bodies.dynamic_count, pair.a);
    write_velocities<Real, W>(bodies.change, block.row_b, bodies.dynamic_count, pair.b);
}

/// Opposite impulses at one common point.
template <class T>
inline void apply(PairVelocity<T>& pair, const PairMass<T>& mass, const Vector3<T>& r_a,
                  const Vector3<T>& r_b, const Vector3<T>& impulse) {
    apply_impulse<T>(pair.a, mass.a, r_a, impulse);
    apply_impulse<T>(pair.b, mass.b, r_b, -impulse);
}

template <class T>
struct Tangents {
    Vector3<T> x, y;
};

template <class Real, int W, class T = Number<Real, W>>
inline Tangents<T> load_tangents(const FrictionRow<Real, W>& row, const Vector3<T>& n) {
    const Vector3<T> t = load_vector(row.tangent);
    return {t, cross<T>(n, t)};
}

// ---- once a step, and in each substep that finds the bodies elsewhere

template <class Real, int W>
void take_masses(const ContactArrays<Real, W>& arrays, const Real* masses, std::uint32_t first,
                 std::uint32_t last) {
    for (std::uint32_t i = first; i < last; ++i) {
        PairBlock<Real, W>& block = arrays.blocks[i];
        read_masses<Real, W>(masses, block.row_a, block.inverse_mass_a, block.inverse_inertia_a);
        read_masses<Real, W>(masses, block.row_b, block.inverse_mass_b, block.inverse_inertia_b);
    }
}

template <class Real, int W, ContactVariant V>
void prepare(const ContactArrays<Real, W>& arrays, const BodyRows<Real>&, const PassSettings<Real>&,
             std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    for (std::uint32_t i = first; i < last; ++i) {
        const PairBlock<Real, W>& block = arrays.blocks[i];
        const PairMass<T> mass = load_masses(block);
        for (std::uint32_t k = block.first_row; k < block.first_row + block.row_count; ++k) {
            NormalRow<Real, W>& row = arrays.normals[k];
            const Vector3<T> n = load_vector(row.normal), r_a = load_vector(row.arm_a),
                             r_b = load_vector(row.arm_b);
            auto k_of = [&](const Vector3<T>& d, const Vector3<T>& e) {
                return response<T>(mass.a, r_a, d, e) + response<T>(mass.b, r_b, d, e);
            };
            store(row.effective_mass, inverse_or_zero<T>(k_of(n, n)));
            if constexpr (V != ContactVariant::frictionless) {
                FrictionRow<Real, W>& across = arrays.frictions[k];
                const Vector3<T> x = tangent_of<T>(n), y = cross<T>(n, x);
                const T xx = k_of(x, x), xy = k_of(x, y), yy = k_of(y, y);
                const TangentMass<T> tangent = tangent_mass<T>(xx, xy, yy, inverse_or_zero<T>);
                store_vector(across.tangent, x);
                store(across.mass_xx, tangent.xx);
                store(across.mass_xy, tangent.xy);
                store(across.mass_yy, tangent.yy);
                store(across.mass_least, tangent.least);
                store(across.coupling_x, k_of(x, n));
                store(across.coupling_y, k_of(y, n));
                if constexpr (V == ContactVariant::rolling) {
                    RollingRow<Real, W>& rolling = arrays.rollings[k];
                    const TangentMass<T> inertia = rolling_inertia<T>(
                        angular_response<T>(mass.a, mass.b, x, x),
                        angular_response<T>(mass.a, mass.b, x, y),
                        angular_response<T>(mass.a, mass.b, y, y), inverse_or_zero<T>);
                    store(rolling.inertia_xx, inertia.xx);
                    store(rolling.inertia_xy, inertia.xy);
                    store(rolling.inertia_yy, inertia.yy);
                    store(rolling.inertia_least, inertia.least);
                    store(rolling.inertia_n,
                          inverse_or_zero<T>(angular_response<T>(mass.a, mass.b, n, n)));
                }
            }
        }
    }
}

// ---- once a substep

/// Sums of the substep before become the start of this one, or nothing without warm starting.
template <class T>
inline T carried_over(const T& velocity_pass, const T& position_pass, bool warm_start) {
    return warm_start ? velocity_pass + position_pass : T(0);
}

template <class Real, int W, ContactVariant V>
void begin(const ContactArrays<Real, W>& arrays, const BodyRows<Real>& bodies,
           const PassSettings<Real>& pass, std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    for (std::uint32_t i = first; i < last; ++i) {
        const PairBlock<Real, W>& block = arrays.blocks[i];
        const PairVelocity<T> pair = read_pair(bodies.start, block);
        for (std::uint32_t k = block.first_row; k < block.first_row + block.row_count; ++k) {
            NormalRow<Real, W>& row = arrays.normals[k];
            const Vector3<T> n = load_vector(row.normal);
            const Vector3<T> u = velocity_at<T>(pair.a, load_vector(row.arm_a)) -
                                 velocity_at<T>(pair.b, load_vector(row.arm_b));
            store(row.velocity, dot<T>(n, u));
            store(row.lambda_velocity, carried_over<T>(load(row.lambda_velocity),
                                                       load(row.lambda_position), pass.warm_start));
            store(row.lambda_position, T(0));
            if constexpr (V != ContactVariant::frictionless) {
                FrictionRow<Real, W>& across = arrays.frictions[k];
                const Tangents<T> t = load_tangents(across, n);
                store(across.velocity_x, T(dot<T>(t.x, u) + load(across.anchor_velocity_x)));
                store(across.velocity_y, T(dot<T>(t.y, u) + load(across.anchor_velocity_y)));
                store(across.lambda_velocity_x,
                      carried_over<T>(load(across.lambda_velocity_x),
                                      load(across.lambda_position_x), pass.warm_start));
                store(across.lambda_velocity_y,
                      carried_over<T>(load(across.lambda_velocity_y),
                                      load(across.lambda_position_y), pass.warm_start));
                store(across.lambda_position_x, T(0));
                store(across.lambda_position_y, T(0));
                if constexpr (V == ContactVariant::rolling) {
                    RollingRow<Real, W>& rolling = arrays.rollings[k];
                    const Vector3<T> w = pair.a.w - pair.b.w;
                    store(rolling.rate_x, dot<T>(t.x, w));
                    store(rolling.rate_y, dot<T>(t.y, w));
                    store(rolling.rate_n, dot<T>(n, w));
                    store(rolling.torque_x, T(0));
                    store(rolling.torque_y, T(0));
                    store(rolling.torque_n, T(0));
                }
            }
        }
    }
}

template <class Real, int W, ContactVariant V>
void warm_start(const ContactArrays<Real, W>& arrays, const BodyRows<Real>& bodies,
                const PassSettings<Real>&, std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    for (std::uint32_t i = first; i < last; ++i) {
        const PairBlock<Real, W>& block = arrays.blocks[i];
        const PairMass<T> mass = load_masses(block);
        PairVelocity<T> pair = read_pair<Real, W>(bodies.change, block);
        for (std::uint32_t k = block.first_row; k < block.first_row + block.row_count; ++k) {
            const NormalRow<Real, W>& row = arrays.normals[k];
            const Vector3<T> n = load_vector(row.normal);
            Vector3<T> impulse = n * load(row.lambda_velocity);
            if constexpr (V != ContactVariant::frictionless) {
                const FrictionRow<Real, W>& across = arrays.frictions[k];
                const Tangents<T> t = load_tangents(across, n);
                impulse +=
                    t.x * load(across.lambda_velocity_x) + t.y * load(across.lambda_velocity_y);
            }
            apply<T>(pair, mass, load_vector(row.arm_a), load_vector(row.arm_b), impulse);
        }
        write_pair(bodies, block, pair);
    }
}

// ---- iterations

/// Which unknown a pass solves for, and so which sums it adds to.
enum class Pass { velocity, position };

/// Velocity along n that the velocity pass asks for: a separated contact may close by gap/h, no
/// more; a collision bounces.
template <class Real, int W, class T = Number<Real, W>>
inline T wanted_velocity(const NormalRow<Real, W>& row, const PassSettings<Real>& pass) {
    const T bounce = load(row.restitution_velocity);
    const T closing = -max(load(row.gap), T(0)) * T(pass.inverse_h);
    return select_greater(bounce, T(0), bounce, closing);
}

/// Gap that the position pass closes in this iteration [m], given the velocity u along n now.
template <class Real, int W, class T = Number<Real, W>>
inline T remaining_gap(const NormalRow<Real, W>& row, const PassSettings<Real>& pass, const T& u) {
    const T gap = load(row.gap), h(pass.h), s(pass.stiffness),
            bounce = load(row.restitution_velocity);
    const T left = overlap_left<T>(gap, T(pass.recovery));
    const T c = (gap + h * u) - left, d = min(gap, T(0)) - left;
    const T resting = pass.shared_push ? gap_below(c, d, s) : gap_to_solve<T>(c, d, s);
    // a bounce moves the bodies out of their overlap by itself, and the recovery adds nothing to
    // it
    return select_greater(bounce, T(0), h * (u - bounce), resting);
}

/// Push of one iteration: an impulse, of which a displacement is m C / h (§3, end).
template <Pass P, class Real, int W, class T = Number<Real, W>>
inline T push_row(NormalRow<Real, W>& row, const PassSettings<Real>& pass, const T& u) {
    const T mass = load(row.effective_mass);
    if constexpr (P == Pass::velocity) {
        T lambda = load(row.lambda_velocity);
        const T change = push<T>(lambda, mass * (wanted_velocity<Real, W>(row, pass) - u), T(0));
        store(row.lambda_velocity, lambda);
        return change;
    } else {
        T lambda = load(row.lambda_position);
        const T least = pass.shared_push ? -load(row.lambda_velocity) : T(0);
        const T change = push<T>(
            lambda, -remaining_gap<Real, W>(row, pass, u) * (mass * T(pass.inverse_h)), least);
        store(row.lambda_position, lambda);
        return change;
    }
}

/// Friction of one point: returns its impulse. u is the velocity before the push along n was made.
template <Pass P, class Real, int W, class T = Number<Real, W>>
inline Vector3<T> friction_row(FrictionRow<Real, W>& row, const NormalRow<Real, W>& normal,
                               const Vector3<T>& n, const Vector3<T>& u,
                               const PassSettings<Real>& pass, const T& pushed) {
    const Tangents<T> t = load_tangents(row, n);
    const Planar<T> velocity{
        load(row.velocity_x) + (dot<T>(t.x, u) + load(row.coupling_x) * pushed),
        load(row.velocity_y) + (dot<T>(t.y, u) + load(row.coupling_y) * pushed)};
    const TangentMass<T> mass{load(row.mass_xx), load(row.mass_xy), load(row.mass_yy),
                              load(row.mass_least)};
    const T velocity_sum = load(normal.lambda_velocity),
            position_sum = load(normal.lambda_position);

    Planar<T> change;
    Planar<T> lambda_velocity{load(row.lambda_velocity_x), load(row.lambda_velocity_y)};
    if constexpr (P == Pass::velocity) {
        const T bound = load(row.friction) * velocity_sum;
        change = solve_friction<T>(lambda_velocity, {T(0), T(0)}, velocity, mass, bound);
        store(row.lambda_velocity_x, lambda_velocity.x);
        store(row.lambda_velocity_y, lambda_velocity.y);
    } else {
        Planar<T> lambda_position{load(row.lambda_position_x), load(row.lambda_position_y)};
        const T push = pass.shared_cone ? velocity_sum + position_sum : position_sum;
        if (!pass.shared_cone) lambda_velocity = {T(0), T(0)};
        change = solve_friction<T>(lambda_position, lambda_velocity, velocity, mass,
                                   T(load(row.friction) * push));
        store(row.lambda_position_x, lambda_position.x);
        store(row.lambda_position_y, lambda_position.y);
    }
    return t.x * change.x + t.y * change.y;
}

/// Rolling and spinning friction of one point: torques, applied at once.
template <class Real, int W, class T = Number<Real, W>>
inline void resist_rolling(RollingRow<Real, W>& row, const NormalRow<Real, W>& normal,
                           const FrictionRow<Real, W>& across, const Vector3<T>& n,
                           PairVelocity<T>& pair, const PairMass<T>& mass) {
    const Tangents<T> t = load_tangents(across, n);
    const Vector3<T> w = pair.a.w - pair.b.w;
    const T push = load(normal.lambda_velocity) + load(normal.lambda_position);
    const Planar<T> rate{load(row.rate_x) + dot<T>(t.x, w), load(row.rate_y) + dot<T>(t.y, w)};
    const TangentMass<T> inertia{load(row.inertia_xx), load(row.inertia_xy), load(row.inertia_yy),
                                 load(row.inertia_least)};
    Planar<T> across_sum{load(row.torque_x), load(row.torque_y)};
    const Planar<T> rolled =
        solve_friction<T>(across_sum, {T(0), T(0)}, rate, inertia, T(load(row.rolling) * push));
    store(row.torque_x, across_sum.x);
    store(row.torque_y, across_sum.y);

    T about = load(row.torque_n);
    const T spun = resist_spin<T>(about, load(row.rate_n) + dot<T>(n, w), load(row.inertia_n),
                                  T(load(row.spinning) * push));
    store(row.torque_n, about);

    const Vector3<T> torque = t.x * rolled.x + t.y * rolled.y + n * spun;
    apply_torque<T>(pair.a, mass.a, torque);
    apply_torque<T>(pair.b, mass.b, -torque);
}

template <Pass P, class Real, int W, ContactVariant V, class T = Number<Real, W>>
inline void solve_row(const ContactArrays<Real, W>& arrays, std::uint32_t k, PairVelocity<T>& pair,
                      const PairMass<T>& mass, const PassSettings<Real>& pass) {
    NormalRow<Real, W>& row = arrays.normals[k];
    const Vector3<T> n = load_vector(row.normal), r_a = load_vector(row.arm_a),
                     r_b = load_vector(row.arm_b);
    if constexpr (V == ContactVariant::rolling)
        resist_rolling<Real, W>(arrays.rollings[k], row, arrays.frictions[k], n, pair, mass);

    const Vector3<T> u = velocity_at<T>(pair.a, r_a) - velocity_at<T>(pair.b, r_b);
    const T pushed = push_row<P, Real, W>(row, pass, load(row.velocity) + dot<T>(n, u));
    Vector3<T> impulse = n * pushed;
    // friction comes second, so that it ends inside of the cone of the push as it is then
    if constexpr (V != ContactVariant::frictionless)
        impulse += friction_row<P, Real, W>(arrays.frictions[k], row, n, u, pass, pushed);
    apply<T>(pair, mass, r_a, r_b, impulse);
}

template <Pass P, class Real, int W, ContactVariant V>
[[gnu::flatten]] void solve(const ContactArrays<Real, W>& arrays, const BodyRows<Real>& bodies,
                            const PassSettings<Real>& pass, std::uint32_t first,
                            std::uint32_t last) {
    using T = Number<Real, W>;
    for (std::uint32_t i = first; i < last; ++i) {
        const PairBlock<Real, W>& block = arrays.blocks[i];
        const PairMass<T> mass = load_masses(block);
        PairVelocity<T> pair = read_pair<Real, W>(bodies.change, block);
        for (std::uint32_t j = 0; j < block.row_count; ++j) {
            const std::uint32_t k = pass.forwards ? j : block.row_count - 1 - j;
            solve_row<P, Real, W, V>(arrays, block.first_row + k, pair, mass, pass);
        }
        write_pair(bodies, block, pair);
    }
}

}  // namespace plumb::kernels
