// SPDX-License-Identifier: MIT
/// Small matrices written out in full.
#pragma once

#include "math/symmetric.h"
#include "math/types.h"

namespace plumb {

/// [r]ₓ: what multiplies ω to give r × ω.
inline Matrix3d skew(const Vector3d& r) {
    Matrix3d m;
    m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    return m;
}

/// m [r]ₓ and [r]ₓ m.
inline Matrix3d times_skew(const Matrix3d& m, const Vector3d& r) {
    Matrix3d product;
    product << r.z() * m.col(1) - r.y() * m.col(2), r.x() * m.col(2) - r.z() * m.col(0),
        r.y() * m.col(0) - r.x() * m.col(1);
    return product;
}
inline Matrix3d skew_times(const Vector3d& r, const Matrix3d& m) {
    Matrix3d product;
    for (int k = 0; k < 3; ++k) product.col(k) = cross<double>(r, m.col(k));
    return product;
}

inline Matrix3d matrix_of(const Symmetric3<double>& s) {
    Matrix3d m;
    m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
    return m;
}

}  // namespace plumb
