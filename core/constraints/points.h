// SPDX-License-Identifier: MIT
/// A constraint among N points, solved by Eq. 6 with compliance.
///
///   p  points at the end of the substep as things stand [m]
///   C  what the rows ask to be 0; G = ∂C/∂p, one vector a row and a point
///   α  compliance of a row: C = −α f, with f the generalised force [unit of C over that of f]
///   τ  time constant of the damping: C + τ dC/dt = −α f [s]
///   P  summed impulse of a row, h f
///
/// A particle's connector is the identity (§7), so a point is moved by w G P alone. The end of the
/// substep decides both C and G, which is implicit Euler: no step is too long, and what swings
/// faster than a substep resolves dies away.
#pragma once

#include "math/dense.h"
#include "math/types.h"

#include <Eigen/Eigenvalues>

namespace plumb {

/// C of R rows among N points, and its gradient.
template <class T, int N, int R>
struct PointRows {
    T c[R];
    Vector3<T> gradient[R][N];
};

/// One row that is linear in the points, for each of the three directions: C = Σ cᵢ pᵢ.
template <class T, int N>
struct LinearRow {
    T weight[N];
};

/// s of a row: α/h² with the share of the damping, so that (G w Gᵀ + s) ΔP = −((C − lag)/h + s P).
inline double point_softness(double compliance, double damping, double h) {
    return compliance / (h * (h + damping));
}
/// The share of C at the start of the substep that damping takes off C at its end: τ / (h + τ).
inline double point_lag(double damping, double h) { return damping / (h + damping); }

/// A stress without its negative principal values.
template <int N>
inline Eigen::Matrix<double, N, N> pulling_part(const Eigen::Matrix<double, N, N>& stress) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> principal;
    principal.computeDirect(stress);
    return principal.eigenvectors() * principal.eigenvalues().cwiseMax(0).asDiagonal() *
           principal.eigenvectors().transpose();
}

/// Solves all rows as one block. Adds to the points' velocities and to the impulses.
template <class T, int N, int R>
inline void solve_points(Vector3<T> (&velocity)[N], const T (&inverse_mass)[N],
                         const PointRows<T, N, R>& rows, const T (&lag)[R], const T (&softness)[R],
                         T (&impulse)[R], const T& h) {
    T k[R][R], change[R];
    for (int r = 0; r < R; ++r) {
        for (int s = 0; s <= r; ++s) {
            k[r][s] = inverse_mass[0] * dot(rows.gradient[r][0], rows.gradient[s][0]);
            for (int i = 1; i < N; ++i)
                k[r][s] += inverse_mass[i] * dot(rows.gradient[r][i], rows.gradient[s][i]);
        }
        k[r][r] += softness[r];
        change[r] = (lag[r] - rows.c[r]) / h - softness[r] * impulse[r];
    }
    solve_ldlt<T, R>(k, change);
    for (int r = 0; r < R; ++r) {
        impulse[r] += change[r];
        for (int i = 0; i < N; ++i)
            velocity[i] += rows.gradient[r][i] * (inverse_mass[i] * change[r]);
    }
}

/// The same for a linear row, whose three directions do not feel each other.
template <class T, int N>
inline void solve_points(Vector3<T> (&velocity)[N], const T (&inverse_mass)[N],
                         const LinearRow<T, N>& row, const Vector3<T>& c, const Vector3<T>& lag,
                         const T& softness, Vector3<T>& impulse, const T& h) {
    T k = softness;
    for (int i = 0; i < N; ++i) k += inverse_mass[i] * (row.weight[i] * row.weight[i]);
    const Vector3<T> change = ((lag - c) * (T(1) / h) - impulse * softness) * (T(1) / k);
    impulse += change;
    for (int i = 0; i < N; ++i) velocity[i] += change * (inverse_mass[i] * row.weight[i]);
}

}  // namespace plumb
