// SPDX-License-Identifier: MIT
/// What a joint takes away (§5): up to three translations and three rotations, solved together as
/// one block by Eq. 6.
///
///   along k  C = e_k · (p_a − p_b)   e_k rides on b    ∂C: e_k on v_a, r_a × e_k on ω_a,
///                                                      −e_k on v_b, −(p_a − x_b) × e_k on ω_b
///   about k  C = u_k · w_k           u_k on a, w_k on b   ∂C: ±(u_k × w_k) on ω_a, ω_b
///
/// for d(e · (p_a − p_b)) also turns e: ω_b × e · (p_a − p_b), which moves b's arm out to p_a. So
/// both bodies feel opposite impulses at one point. Rotation is not linear: C is taken anew at each
/// iteration, from the turn of the whole substep. Where the impulses act is said in joint_lever.h.
/// A row with compliance α is a spring of stiffness 1/α, which by spring.h has C − lag + s h λ = 0
/// for the impulse λ of the whole substep, with the softness s = α/(θ h²) on the diagonal.
#pragma once

#include "constraints/joint_lever.h"
#include "math/dense.h"
#include "math/lanes.h"

namespace plumb {

/// A joint at the start of a substep, world frame.
template <class T>
struct JointGeometry {
    Vector3<T> r_a, r_b;  ///< arms [m]
    Vector3<T> apart;     ///< p_a − p_b [m]
    Vector3<T> e[3], u[3], w[3];
    T lock[6];      ///< 1 where the row is taken away, else 0
    T softness[6];  ///< s [1/kg], [1/(kg m²)]
    T lag[6];       ///< 0 where a row is rigid [m], [rad]
    JointLever<T> lever_a, lever_b;
    T length;             ///< of a distance joint, whose row 0 is along the line between the
                          ///< points; else 0 [m]
    T line_share;         ///< and how that line turns, as a lever does: share of what the points
    Vector3<T> line_lag;  ///< move apart in the substep, and what the past adds [m]
};

template <class T>
struct JointRows {
    T c[6];                     ///< [m], [rad]
    Vector3<T> e[3];            ///< what the impulse of a translational row does to v
    Vector3<T> g_a[6], g_b[6];  ///< and what each row's does to ω
    Vector3<T> arm_a, arm_b;    ///< at which impulses act [m]
};

/// A joint at the preview poses: x₀ + h v, turned by h ω.
template <class T>
struct JointPreview {
    Turn<T> turn_a, turn_b;
    Vector3<T> apart;  ///< p_a − p_b [m]

    JointPreview(const JointGeometry<T>& joint, const Velocity<T>& a, const Velocity<T>& b,
                 const T& h)
        : turn_a(a.w * h),
          turn_b(b.w * h),
          apart(joint.apart + (a.v - b.v) * h +
                (turn_a.change(joint.r_a) - turn_b.change(joint.r_b))) {}
    /// At the start of the substep.
    explicit JointPreview(const JointGeometry<T>& joint) : apart(joint.apart) {}
};

/// C of the rows that are taken away, less their lag. Of the others it means nothing.
template <class T>
inline void joint_errors(T (&c)[6], const JointGeometry<T>& joint, const JointPreview<T>& now) {
    for (int k = 0; k < 3; ++k) {
        c[k] = c[3 + k] = T(0);
        if (any_greater(joint.lock[k], T(0)))
            c[k] = dot(Vector3<T>(joint.e[k] + now.turn_b.change(joint.e[k])), now.apart);
        if (any_greater(joint.lock[3 + k], T(0)))
            c[3 + k] = dot(Vector3<T>(joint.u[k] + now.turn_a.change(joint.u[k])),
                           Vector3<T>(joint.w[k] + now.turn_b.change(joint.w[k])));
    }
    if (any_greater(joint.length, T(0))) {
        const T distance = sqrt(dot(now.apart, now.apart));
        c[0] = select_greater(joint.length, T(0), distance - joint.length, c[0]);
    }
    for (int k = 0; k < 6; ++k) c[k] = c[k] - joint.lag[k];
}

/// The part of an old error that is left for later steps, where one may close it by `most` [m],
/// [rad]: from 0 to 1.
template <class T>
inline T deferred_fraction(const T& squared, const T& most) {
    const T size = sqrt(squared);
    return select_greater(size, most, T(1) - most / max(size, T(1e-300)), T(0));
}

/// What impulses along the rows do to the bodies. `apart`: p_a − p_b at the preview poses [m];
/// `meet`: 1 where impulses act on both bodies at the point of a, which keeps angular momentum; 0
/// where they act on each at its own, which is the derivative of C.
template <class T>
inline void joint_axes(JointRows<T>& rows, const JointGeometry<T>& joint, const Velocity<T>& a,
                       const Velocity<T>& b, const T& h, const Vector3<T>& apart,
                       const T& meet = T(1)) {
    const LeverTurn<T> lever_a(joint.lever_a, a.w * h), lever_b(joint.lever_b, b.w * h);
    const Vector3<T> opened = apart - joint.apart;
    const JointArms<T> arms(lever_a, lever_b, joint.lever_b.share, joint.r_a, joint.r_b,
                            joint.apart * meet, opened * meet);
    rows.arm_a = arms.a, rows.arm_b = arms.b;
    const Vector3<T> none(T(0), T(0), T(0));
    for (int k = 0; k < 3; ++k) {
        rows.e[k] = rows.g_a[3 + k] = rows.g_b[3 + k] = none;
        if (any_greater(joint.lock[k], T(0))) rows.e[k] = joint.e[k] + lever_b.change(joint.e[k]);
        if (any_greater(joint.lock[3 + k], T(0)))
            rows.g_a[3 + k] = rows.g_b[3 + k] =
                cross(Vector3<T>(joint.u[k] + lever_a.change(joint.u[k])),
                      Vector3<T>(joint.w[k] + lever_b.change(joint.w[k])));
    }
    if (any_greater(joint.length, T(0))) {
        const Vector3<T> line = joint.apart + opened * joint.line_share + joint.line_lag;
        const T scale = T(1) / sqrt(max(dot(line, line), T(1e-30)));
        for (int i = 0; i < 3; ++i)
            rows.e[0][i] = select_greater(joint.length, T(0), line[i] * scale, rows.e[0][i]);
    }
    for (int k = 0; k < 3; ++k) {
        rows.g_a[k] = cross(arms.a, rows.e[k]);
        rows.g_b[k] = cross(arms.b, rows.e[k]);
    }
}

/// Errors, and what impulses do, at the preview poses.
template <class T>
inline JointRows<T> joint_rows(const JointGeometry<T>& joint, const Velocity<T>& a,
                               const Velocity<T>& b, const T& h) {
    const JointPreview<T> now(joint, a, b, h);
    JointRows<T> rows;
    joint_errors<T>(rows.c, joint, now);
    joint_axes<T>(rows, joint, a, b, h, now.apart);
    return rows;
}

/// Impulses λ of the rows, on both bodies.
template <class T>
inline void apply_rows(Velocity<T>& a, Velocity<T>& b, const InverseMass<T>& mass_a,
                       const InverseMass<T>& mass_b, const JointRows<T>& rows,
                       const T (&lambda)[6]) {
    const Vector3<T> push = rows.e[0] * lambda[0] + rows.e[1] * lambda[1] + rows.e[2] * lambda[2];
    Vector3<T> turn_a = rows.g_a[0] * lambda[0], turn_b = rows.g_b[0] * lambda[0];
    for (int k = 1; k < 6; ++k) {
        turn_a += rows.g_a[k] * lambda[k];
        turn_b += rows.g_b[k] * lambda[k];
    }
    a.v += push * mass_a.mass;
    a.w += mass_a.inertia * turn_a;
    b.v -= push * mass_b.mass;
    b.w -= mass_b.inertia * turn_b;
}

/// K = J M⁻¹ Jᵀ, its lower triangle; rows that are not taken away stand alone.
template <class T>
inline void joint_response(T (&k)[6][6], const JointRows<T>& rows, const JointGeometry<T>& joint,
                           const InverseMass<T>& mass_a, const InverseMass<T>& mass_b) {
    const T mass = mass_a.mass + mass_b.mass;
    for (int j = 0; j < 6; ++j) {
        const Vector3<T> on_a = mass_a.inertia * rows.g_a[j], on_b = mass_b.inertia * rows.g_b[j];
        for (int i = j; i < 6; ++i) {
            T entry = dot(rows.g_a[i], on_a) + dot(rows.g_b[i], on_b);
            if (i < 3) entry = entry + mass * dot(rows.e[i], rows.e[j]);
            k[i][j] = entry * joint.lock[i] * joint.lock[j];
        }
        k[j][j] = k[j][j] + joint.softness[j] * joint.lock[j] + (T(1) - joint.lock[j]);
    }
}

/// How far a body may turn for rows to say anything of where it comes to [rad], and so how far one
/// iteration turns it at most: the gradient of a rotational row vanishes at a right angle, so that
/// Eq. 6 would ask for a turn without bounds near there.
inline constexpr double kTrustedTurn = 0.5;

/// The share of changes of both bodies' velocities that turns neither farther than that: 1 but for
/// what whips round.
template <class T>
inline T trusted_share(const Velocity<T>& a, const Velocity<T>& b, const T& h) {
    const T rate = sqrt(max(dot(a.w, a.w), dot(b.w, b.w))), most = T(kTrustedTurn) / h;
    return select_greater(rate, most, most / max(rate, most), T(1));
}

/// One iteration of Eq. 6: all rows at once. `change` is corrected; `total` is the whole velocity.
template <class T>
inline void solve_joint(Velocity<T>& change_a, Velocity<T>& change_b, const Velocity<T>& total_a,
                        const Velocity<T>& total_b, const InverseMass<T>& mass_a,
                        const InverseMass<T>& mass_b, const JointGeometry<T>& joint, T (&lambda)[6],
                        const T& h) {
    const JointRows<T> rows = joint_rows<T>(joint, total_a, total_b, h);
    T k[6][6];
    joint_response<T>(k, rows, joint, mass_a, mass_b);
    T push[6];
    for (int i = 0; i < 6; ++i)
        push[i] = -(rows.c[i] / h + joint.softness[i] * lambda[i]) * joint.lock[i];
    solve_ldlt<T, 6>(k, push);
    const Vector3<T> none(T(0), T(0), T(0));
    Velocity<T> a{none, none}, b{none, none};
    apply_rows<T>(a, b, mass_a, mass_b, rows, push);
    const T share = trusted_share<T>(a, b, h);
    for (int i = 0; i < 6; ++i) lambda[i] = lambda[i] + push[i] * share;
    change_a.v += a.v * share, change_a.w += a.w * share;
    change_b.v += b.v * share, change_b.w += b.w * share;
}

}  // namespace plumb
