// SPDX-License-Identifier: MIT
/// The formulas of §6 and Eq. 6 against numbers worked out by hand, and against plain matrices.
#include "constraints/connector.h"
#include "constraints/contact.h"
#include "constraints/friction.h"
#include "math/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace plumb {
namespace {

TEST(ContactFormulas, GapToSolveGivesNewOverlapInFullAndOldOverlapByS) {
    EXPECT_DOUBLE_EQ(gap_to_solve(-0.03, -0.01, 0.2), -0.02 + 0.2 * -0.01);  // deeper than at first
    EXPECT_DOUBLE_EQ(gap_to_solve(-0.004, -0.01, 0.2), 0.2 * -0.004);        // on its way out
    EXPECT_DOUBLE_EQ(gap_to_solve(-0.01, 0.0, 0.2), -0.01);  // overlap made in this step
    EXPECT_DOUBLE_EQ(gap_to_solve(0.01, 0.0, 0.2),
                     0.2 * 0.01);  // apart: may reduce an earlier push
}

TEST(ContactFormulas, PushStaysRepulsiveInSum) {
    double lambda = 2;
    EXPECT_DOUBLE_EQ(push(lambda, -5.0, 0.0), -2);
    EXPECT_DOUBLE_EQ(lambda, 0);
    EXPECT_DOUBLE_EQ(push(lambda, 3.0, 0.0), 3);
    EXPECT_DOUBLE_EQ(lambda, 3);
}

TEST(ContactFormulas, OverlapIsLeftBeyondWhatASubstepMayPushOut) {
    EXPECT_DOUBLE_EQ(overlap_left(-0.5, 0.01), -0.49);
    EXPECT_DOUBLE_EQ(overlap_left(-0.005, 0.01), 0);
    EXPECT_DOUBLE_EQ(overlap_left(0.2, 0.01), 0);
}

TEST(ContactFormulas, FrictionStaysInARoundCone) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-3, 3);
    for (int i = 0; i < 1000; ++i) {
        const TangentMass<double> mass =
            tangent_mass<double>(2 + number(random) / 4, number(random) / 8, 3,
                                 [](double x) { return x > 0 ? 1 / x : 0; });
        Planar<double> f{0, 0};
        const double bound = std::abs(number(random));
        solve_friction<double>(f, {0, 0}, {number(random), number(random)}, mass, bound);
        EXPECT_LE(std::hypot(f.x, f.y), bound * (1 + 1e-12));
    }
}

/// Against a body that keeps sliding, friction settles at the bound and straight against the
/// sliding.
TEST(ContactFormulas, FrictionOpposesTheSlidingWhateverTheInertia) {
    const TangentMass<double> mass = tangent_mass<double>(5, 1, 1, [](double x) { return 1 / x; });
    Planar<double> f{0, 0};
    const Planar<double> u{0.6, 0.8};
    for (int i = 0; i < 200; ++i) solve_friction<double>(f, {0, 0}, u, mass, 2.0);
    EXPECT_NEAR(f.x, -1.2, 1e-6);
    EXPECT_NEAR(f.y, -1.6, 1e-6);
}

TEST(ContactFormulas, TangentIsUnitAndAcross) {
    std::mt19937 random(3);
    std::normal_distribution<double> number;
    for (int i = 0; i < 1000; ++i) {
        const Vector3d n = Vector3d(number(random), number(random), number(random)).normalized();
        const Vector3d t = tangent_of<double>(n);
        EXPECT_NEAR(t.norm(), 1, 1e-12);
        EXPECT_NEAR(t.dot(n), 0, 1e-12);
    }
}

Matrix3d skew(const Vector3d& v) {
    Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}
Matrix3d full(const Symmetric3<double>& s) {
    Matrix3d m;
    m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
    return m;
}

TEST(Connector, PointResponseIsJMinvJt) {
    std::mt19937 random(11);
    std::normal_distribution<double> number;
    for (int i = 0; i < 100; ++i) {
        const Matrix3d root = Matrix3d::NullaryExpr([&] { return number(random); });
        const Matrix3d i_inverse = root * root.transpose();
        const InverseMass<double> inverse{0.7,
                                          {i_inverse(0, 0), i_inverse(1, 1), i_inverse(2, 2),
                                           i_inverse(0, 1), i_inverse(0, 2), i_inverse(1, 2)}};
        const Vector3d r(number(random), number(random), number(random));
        const Matrix3d law = 0.7 * Matrix3d::Identity() - skew(r) * i_inverse * skew(r);
        EXPECT_LT((full(point_response(inverse, r)) - law).norm(), 1e-12 * law.norm());
        const Vector3d c(number(random), number(random), number(random));
        EXPECT_LT((law * solve_ldlt<double>(point_response(inverse, r), c) - c).norm(), 1e-9);
    }
}

TEST(Rotation, TurnOfIsTheExponentialMap) {
    std::mt19937 random(5);
    std::normal_distribution<double> number;
    for (int i = 0; i < 1000; ++i) {
        const Vector3d theta =
            Vector3d(number(random), number(random), number(random)).normalized() * 1.5 *
            (i / 1000.0);
        const Vector3d r(number(random), number(random), number(random));
        EXPECT_LT((Turn<double>(theta).change(r) - (exponential_map(theta) * r - r)).norm(),
                  1e-12 * r.norm());
        EXPECT_LT((rotation_vector(exponential_map(theta)) - theta).norm(), 1e-12);
    }
}

}  // namespace
}  // namespace plumb
