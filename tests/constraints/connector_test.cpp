// SPDX-License-Identifier: MIT
/// Connectors (§7) against explicit matrices J = [E, −[r]ₓ] and M⁻¹.
#include "constraints/connector.h"
#include "constraints/point.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace plumb {
namespace {

using test::Random;
using test::skew;
using test::symmetric;
using Connector = Eigen::Matrix<double, 3, 6>;
using Inverse6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

struct Body {
    InverseMass<double> inverse;
    Inverse6 explicit_inverse = Inverse6::Zero();
};
Body random_body(Random& random) {
    const double mass = random.number(0.1, 3);
    const Matrix3d inertia = random.tensor();
    Body body{{mass, symmetric(inertia)}};
    body.explicit_inverse.topLeftCorner<3, 3>() = mass * Matrix3d::Identity();
    body.explicit_inverse.bottomRightCorner<3, 3>() = inertia;
    return body;
}
Connector connector(const Vector3d& r) {
    Connector j;
    j << Matrix3d::Identity(), -skew(r);
    return j;
}
Vector6 stacked(const Velocity<double>& v) {
    Vector6 x;
    x << v.v, v.w;
    return x;
}

TEST(Connector, VelocityOfAPointIsJTimesTheVelocities) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Velocity<double> v{random.vector(), random.vector()};
        const Vector3d r = random.vector();
        EXPECT_LT((velocity_at(v, r) - connector(r) * stacked(v)).norm(), 1e-13);
    }
}

TEST(Connector, AnImpulseChangesVelocitiesByMinvJt) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const Body body = random_body(random);
        const Vector3d r = random.vector(), p = random.vector();
        Velocity<double> v{random.vector(), random.vector()};
        const Vector6 law = stacked(v) + body.explicit_inverse * connector(r).transpose() * p;
        apply_impulse(v, body.inverse, r, p);
        EXPECT_LT((stacked(v) - law).norm(), 1e-12 * (1 + law.norm()));
    }
}

TEST(Connector, ResponseIsAnEntryOfJMinvJt) {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const Body body = random_body(random);
        const Vector3d r = random.vector(), d = random.vector(), e = random.vector();
        const Matrix3d k = connector(r) * body.explicit_inverse * connector(r).transpose();
        EXPECT_NEAR(response(body.inverse, r, d, e), d.dot(k * e), 1e-11 * (1 + k.norm()));
        EXPECT_LT((test::full(point_response(body.inverse, r)) - k).norm(), 1e-12 * k.norm());
    }
}

/// One iteration moves two resting bodies' points together, but for the second order of the turn.
TEST(BallJoint, OneIterationClosesASmallGap) {
    Random random(4);
    const double h = 0.01;
    for (int i = 0; i < 100; ++i) {
        const Body a = random_body(random), b = random_body(random);
        const Vector3d r_a = random.vector(), r_b = random.vector(),
                       gap = 1e-5 * random.direction();
        const Velocity<double> rest{Vector3d::Zero(), Vector3d::Zero()};
        Velocity<double> x = rest, y = rest;
        const Vector3d impulse = join(x, y, rest, rest, a.inverse, b.inverse, r_a, r_b, gap,
                                      {1, Vector3d::Zero()}, {1, Vector3d::Zero()}, h);
        const Vector3d left = gap + h * (x.v - y.v) + Turn<double>(h * x.w).change(r_a) -
                              Turn<double>(h * y.w).change(r_b);
        EXPECT_LT(left.norm(), 1e-3 * gap.norm());
        EXPECT_LT((x.v / a.inverse.mass + y.v / b.inverse.mass).norm(), 1e-12 * impulse.norm());
    }
}

/// Bodies that turn by half a radian in the step: few iterations reach rounding.
TEST(BallJoint, ConvergesFastForFastTurns) {
    Random random(5);
    const double h = 0.01;
    const Body a = random_body(random), b = random_body(random);
    const Velocity<double> start_a{random.vector(), 50 * random.direction()};
    const Velocity<double> start_b{random.vector(), 50 * random.direction()};
    const Vector3d r_a(0.3, 0, 0.1), r_b(-0.2, 0.2, 0), gap = Vector3d::Zero();
    Velocity<double> x{Vector3d::Zero(), Vector3d::Zero()}, y = x;
    auto sum = [](const Velocity<double>& u, const Velocity<double>& v) {
        return Velocity<double>{u.v + v.v, u.w + v.w};
    };
    auto error = [&] {
        const Velocity<double> p = sum(start_a, x), q = sum(start_b, y);
        return (h * (p.v - q.v) + Turn<double>(h * p.w).change(r_a) -
                Turn<double>(h * q.w).change(r_b))
            .norm();
    };
    EXPECT_GT(error(), 0.01);
    for (int i = 0; i < 30; ++i)
        join(x, y, sum(start_a, x), sum(start_b, y), a.inverse, b.inverse, r_a, r_b, gap,
             {1, Vector3d::Zero()}, {1, Vector3d::Zero()}, h);
    EXPECT_LT(error(), 1e-12);
}

}  // namespace
}  // namespace plumb
