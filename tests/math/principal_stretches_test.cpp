// SPDX-License-Identifier: MIT
/// Principal stretches of maps that are regular, inside out, flat, thin and nothing at all.
#include "math/principal_stretches.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumb {
namespace {

using test::Random;

template <class T>
class PrincipalStretchesOf : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(PrincipalStretchesOf, Reals);

template <class T>
Matrix3d matrix_of(const Vector3<T> (&columns)[3]) {
    Matrix3d m;
    for (int k = 0; k < 3; ++k) m.col(k) = columns[k].template cast<double>();
    return m;
}

/// F = u s vᵀ with right-handed frames, and the order of the stretches.
template <class T>
void expect_stretches(const Matrix3d& f) {
    Vector3<T> columns[3];
    for (int k = 0; k < 3; ++k) columns[k] = f.col(k).cast<T>();
    const PrincipalStretches<T> p = principal_stretches_of<T>(columns);
    const double rounding = 30 * static_cast<double>(std::numeric_limits<T>::epsilon());
    const Matrix3d u = matrix_of(p.now), v = matrix_of(p.rest);
    EXPECT_LT((u.transpose() * u - Matrix3d::Identity()).norm(), rounding);
    EXPECT_LT((v.transpose() * v - Matrix3d::Identity()).norm(), rounding);
    EXPECT_NEAR(u.determinant(), 1, rounding);
    EXPECT_NEAR(v.determinant(), 1, rounding);
    const Vector3d s(p.stretch[0], p.stretch[1], p.stretch[2]);
    // below a stretch of 1e-6 directions are not read off
    EXPECT_LT((u * s.asDiagonal() * v.transpose() - f).norm(), rounding * f.norm() + 4e-6);
    const double slack = rounding * f.norm() + 2e-6;
    EXPECT_GE(s[0], s[1] - slack);
    EXPECT_GE(s[1], std::abs(s[2]) - slack);
    if (std::abs(f.determinant()) > 1e-3) {
        EXPECT_EQ(s[2] < 0, f.determinant() < 0);
    }
}

TYPED_TEST(PrincipalStretchesOf, MapsOfAllKinds) {
    Random random(1);
    const auto drawn = [&] {
        Matrix3d f;
        for (int k = 0; k < 3; ++k) f.col(k) = random.vector(2);
        return f;
    };
    for (int i = 0; i < 5000; ++i) {
        SCOPED_TRACE(i);
        const Matrix3d f = drawn(), turn = random.rotation().toRotationMatrix();
        expect_stretches<TypeParam>(f);
        expect_stretches<TypeParam>(100 * f);
        expect_stretches<TypeParam>(turn);
        expect_stretches<TypeParam>(turn + 1e-5 * f);
        expect_stretches<TypeParam>(turn * Vector3d(1, -0.3, 2).asDiagonal());
        Matrix3d flat = f, thin = f;
        flat.col(2) = 2 * f.col(1) - f.col(0);
        thin.col(1) = 3 * f.col(0), thin.col(2) = -f.col(0);
        expect_stretches<TypeParam>(flat);
        expect_stretches<TypeParam>(thin);
    }
    expect_stretches<TypeParam>(Matrix3d::Identity());
    expect_stretches<TypeParam>(-Matrix3d::Identity());
    expect_stretches<TypeParam>(Matrix3d::Zero());
}

}  // namespace
}  // namespace plumb
