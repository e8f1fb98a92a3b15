// SPDX-License-Identifier: MIT
#include "math/symmetric.h"
#include "math/lanes.h"
#include "math/matrices.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace plumb {
namespace {

using test::full;
using test::Random;
using test::symmetric;

TEST(Symmetric, TimesAVectorIsTheFullMatrixTimesIt) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Matrix3d a = random.tensor(), b = random.tensor();
        const Vector3d v = random.vector();
        EXPECT_LT((symmetric(a) * v - a * v).norm(), 1e-13 * a.norm() * v.norm());
        EXPECT_EQ(full(symmetric(a) + symmetric(b)), full(symmetric(Matrix3d(a + b))));
    }
}

TEST(Symmetric, LdltSolvesWhatADirectInverseSolves) {
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const Matrix3d k = random.tensor();
        const Vector3d c = random.vector();
        const Vector3d law = k.fullPivLu().solve(c);
        EXPECT_LT((solve_ldlt<double>(symmetric(k), c) - law).norm(), 1e-11 * (1 + law.norm()));
    }
}

/// A long thin rod: moments 10⁶ apart still leave a residual at rounding.
TEST(Symmetric, LdltLeavesASmallResidualWhenBadlyScaled) {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const Matrix3d r = random.rotation().toRotationMatrix();
        const Symmetric3<double> k = rotated_diagonal(r, {1e-3, 1, 1e3});
        const Vector3d c = random.vector();
        const Vector3d x = solve_ldlt<double>(k, c);
        EXPECT_LT((full(k) * x - c).norm(), 1e-14 * full(k).norm() * x.norm());
    }
}

TEST(Symmetric, RotatedDiagonalIsRDRt) {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const Matrix3d r = random.rotation().toRotationMatrix();
        const Vector3d d = random.vector();
        const Matrix3d law = r * d.asDiagonal() * r.transpose();
        EXPECT_LT((full(rotated_diagonal(r, d)) - law).norm(), 1e-14 * (1 + law.norm()));
    }
}

/// Lanes run through the same lines as one number.
TEST(Symmetric, LdltIsTheSameInLanes) {
    Random random(5);
    using Four = Lanes<float, 4>;
    alignas(16) float entries[6][4], c[3][4], x[3][4];
    for (int lane = 0; lane < 4; ++lane) {
        const Symmetric3<double> k = symmetric(random.tensor());
        const double values[6] = {k.xx, k.yy, k.zz, k.xy, k.xz, k.yz};
        const Vector3d right = random.vector();
        for (int e = 0; e < 6; ++e) entries[e][lane] = static_cast<float>(values[e]);
        for (int e = 0; e < 3; ++e) c[e][lane] = static_cast<float>(right[e]);
    }
    const Symmetric3<Four> k{load(entries[0]), load(entries[1]), load(entries[2]),
                             load(entries[3]), load(entries[4]), load(entries[5])};
    store_vector(x, solve_ldlt<Four>(k, load_vector(c)));
    for (int lane = 0; lane < 4; ++lane) {
        const Symmetric3<float> one{entries[0][lane], entries[1][lane], entries[2][lane],
                                    entries[3][lane], entries[4][lane], entries[5][lane]};
        const Vector3<float> alone =
            solve_ldlt<float>(one, Vector3<float>(c[0][lane], c[1][lane], c[2][lane]));
        for (int e = 0; e < 3; ++e) EXPECT_EQ(x[e][lane], alone[e]);
    }
}

TEST(Matrices, ProductsWithACrossProductAreTheFullOnes) {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        Matrix3d m;
        for (double& x : m.reshaped()) x = random.number(-2, 2);
        const Vector3d r = random.vector();
        const double most = 1e-14 * m.norm() * r.norm();
        EXPECT_LT((times_skew(m, r) - m * skew(r)).norm(), most);
        EXPECT_LT((skew_times(r, m) - skew(r) * m).norm(), most);
    }
}

}  // namespace
}  // namespace plumb
