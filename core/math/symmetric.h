// SPDX-License-Identifier: MIT
/// Symmetric 3 × 3 matrices over any number type: inverse inertia, and the constraint-space K of
/// Eq. 6.
#pragma once

#include "math/pivot.h"
#include "math/types.h"

namespace plumb {

template <class T>
struct Symmetric3 {
    T xx, yy, zz, xy, xz, yz;

    Vector3<T> operator*(const Vector3<T>& v) const {
        return Vector3<T>((xx * v[0] + xy * v[1]) + xz * v[2], (xy * v[0] + yy * v[1]) + yz * v[2],
                          (xz * v[0] + yz * v[1]) + zz * v[2]);
    }
    friend Symmetric3 operator+(const Symmetric3& a, const Symmetric3& b) {
        return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
    }
};

/// Solves K x = c by LDLᵀ. K is positive definite unless both bodies are immovable.
template <class T>
inline Vector3<T> solve_ldlt(const Symmetric3<T>& k, const Vector3<T>& c) {
    const T l10 = k.xy / k.xx;
    const T l20 = k.xz / k.xx;
    const T d1 = held_pivot<T>(k.yy - l10 * k.xy, k.yy);
    const T off = k.yz - l20 * k.xy;
    const T l21 = off / d1;
    const T d2 = held_pivot<T>((k.zz - l20 * k.xz) - l21 * off, k.zz);
    const T y1 = c[1] - l10 * c[0];
    const T y2 = (c[2] - l20 * c[0]) - l21 * y1;
    const T x2 = y2 / d2;
    const T x1 = y1 / d1 - l21 * x2;
    const T x0 = (c[0] / k.xx - l10 * x1) - l20 * x2;
    return Vector3<T>(x0, x1, x2);
}

/// Of one that is positive definite.
inline Symmetric3<double> inverse(const Symmetric3<double>& k) {
    const Vector3d x = solve_ldlt<double>(k, Vector3d::UnitX()),
                   y = solve_ldlt<double>(k, Vector3d::UnitY()),
                   z = solve_ldlt<double>(k, Vector3d::UnitZ());
    return {x[0], y[1], z[2], x[1], x[2], y[2]};
}

/// R diag(d) Rᵀ for the columns of R.
template <class T>
inline Symmetric3<T> rotated_diagonal(const Vector3<T> (&r)[3], const Vector3<T>& d) {
    const auto entry = [&](int i, int j) {
        return (r[0][i] * d[0] * r[0][j] + r[1][i] * d[1] * r[1][j]) + r[2][i] * d[2] * r[2][j];
    };
    return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}
inline Symmetric3<double> rotated_diagonal(const Matrix3d& r, const Vector3d& d) {
    const Vector3d columns[3] = {r.col(0), r.col(1), r.col(2)};
    return rotated_diagonal<double>(columns, d);
}

}  // namespace plumb
