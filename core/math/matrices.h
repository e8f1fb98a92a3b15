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

inline Matrix3d matrix_of(const Symmetric3<double>& s) {
    Matrix3d m;
    m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
    return m;
}

}  // namespace plumb
