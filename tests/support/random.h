// SPDX-License-Identifier: MIT
/// Numbers, vectors and tensors at random, the same in every run.
#pragma once

#include "math/symmetric.h"
#include "math/types.h"

#include <random>

namespace plumb::test {

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}

    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    std::uint32_t below(std::uint32_t count) {
        return static_cast<std::uint32_t>(engine_() % count);
    }
    Vector3d vector(double size = 1) {
        std::normal_distribution<double> normal;
        const double x = normal(engine_), y = normal(engine_), z = normal(engine_);
        return size * Vector3d(x, y, z);
    }
    Vector3d direction() { return vector().normalized(); }
    Quaterniond rotation() {
        const Vector3d v = vector();
        return Quaterniond(number(-1, 1), v.x(), v.y(), v.z()).normalized();
    }
    /// Positive definite, eigenvalues at least `least`.
    Matrix3d tensor(double least = 0.1) {
        Matrix3d root;
        for (int i = 0; i < 3; ++i) root.col(i) = vector();
        return root * root.transpose() + least * Matrix3d::Identity();
    }

private:
    std::mt19937 engine_;
};

inline Symmetric3<double> symmetric(const Matrix3d& m) {
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
}
inline Matrix3d full(const Symmetric3<double>& s) {
    Matrix3d m;
    m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
    return m;
}
/// [v]ₓ, so that [v]ₓ u = v × u.
inline Matrix3d skew(const Vector3d& v) {
    Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

}  // namespace plumb::test
