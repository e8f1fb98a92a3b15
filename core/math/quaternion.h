// SPDX-License-Identifier: MIT
/// Unit quaternions over any number type, for rotations of many bodies side by side.
#pragma once

#include "math/types.h"

namespace plumb {

/// w + v, the rotation by 2 acos(w) about v.
template <class T>
struct UnitQuaternion {
    Vector3<T> v;
    T w;

    /// The rotation `b` and then this one.
    UnitQuaternion operator*(const UnitQuaternion& b) const {
        return {b.v * w + v * b.w + cross(v, b.v), w * b.w - dot(v, b.v)};
    }
    Vector3<T> operator*(const Vector3<T>& x) const { return x + change(x); }
    /// What the rotation adds to x, without loss where it is small.
    Vector3<T> change(const Vector3<T>& x) const {
        const Vector3<T> twice = cross(v, x) * T(2);
        return twice * w + cross(v, twice);
    }
    UnitQuaternion inverse() const { return {-v, w}; }
    UnitQuaternion normalized() const {
        const T scale = T(1) / sqrt(dot(v, v) + w * w);
        return {v * scale, w * scale};
    }
    /// Columns of the rotation's matrix.
    void columns(Vector3<T> (&axes)[3]) const {
        const T x = v[0] * T(2), y = v[1] * T(2), z = v[2] * T(2);
        const T xx = x * v[0], yy = y * v[1], zz = z * v[2];
        const T xy = x * v[1], xz = x * v[2], yz = y * v[2];
        const T wx = x * w, wy = y * w, wz = z * w;
        axes[0] = Vector3<T>(T(1) - (yy + zz), xy + wz, xz - wy);
        axes[1] = Vector3<T>(xy - wz, T(1) - (xx + zz), yz + wx);
        axes[2] = Vector3<T>(xz + wy, yz - wx, T(1) - (xx + yy));
    }
};

}  // namespace plumb
