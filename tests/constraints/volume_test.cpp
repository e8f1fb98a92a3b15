// SPDX-License-Identifier: MIT
/// The volume inside of a surface, and the numbers that constraints among points share.
#include "constraints/volume.h"
#include "constraints/link.h"
#include "constraints/points.h"
#include "support/random.h"
#include "support/soft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plumb::test {
namespace {

TEST(Volume, OfBallsIsThatOfASphere) {
    const double radius = 0.7, exact = 4 * std::numbers::pi / 3 * std::pow(radius, 3);
    double before = 0;
    for (const std::uint32_t cells : {4u, 8u, 16u, 32u}) {
        const DeformableSpec ball = balloon(radius, cells, {3, -1, 2});
        const double lack =
            1 - volume_of(ball.triangles, [&](std::uint32_t i) { return ball.points[i]; }) / exact;
        EXPECT_GT(lack, 0) << "the faces cut the sphere";
        // of the second order in the length of the edges
        if (before > 0) {
            EXPECT_NEAR(lack, before / 4, 0.1 * before / 4) << cells;
        }
        before = lack;
    }
    EXPECT_LT(before, 0.001);
}

TEST(Volume, GradientIsItsOwnAndSumsUpToNothing) {
    Random random(1);
    DeformableSpec ball = balloon(0.5, 3);
    for (Vector3d& p : ball.points) p += random.vector(0.1);
    const auto place = [&](std::uint32_t i) { return ball.points[i]; };
    std::vector<Vector3d> gradient(ball.points.size(), Vector3d::Zero());
    volume_of(ball.triangles, place, &gradient);
    Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
    for (std::size_t i = 0; i < ball.points.size(); ++i) {
        sum += gradient[i], torque += ball.points[i].cross(gradient[i]);
        for (int k = 0; k < 3; ++k) {
            const double at = ball.points[i][k];
            ball.points[i][k] = at + 1e-5;
            const double ahead = volume_of(ball.triangles, place);
            ball.points[i][k] = at - 1e-5;
            const double behind = volume_of(ball.triangles, place);
            ball.points[i][k] = at;
            EXPECT_NEAR((ahead - behind) / 2e-5, gradient[i][k], 1e-9);
        }
    }
    EXPECT_LT(sum.norm(), 1e-15);
    EXPECT_LT(torque.norm(), 1e-15);
}

/// A mass on a spring with a dashpot, one step of implicit Euler: v' (m + h c + h² k) = m v − h k
/// x.
TEST(PointSoftness, IsOneStepOfASpringAndADashpot) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const double h = random.number(1e-3, 0.1), k = std::pow(10, random.number(-2, 5)),
                     tau = i % 3 == 0 ? 0 : random.number(0, 0.3), m = random.number(0.1, 10),
                     x = random.number(-1, 1), v = random.number(-1, 1);
        const double soft = point_softness(1 / k, tau, h), lag = point_lag(tau, h) * x;
        // (1/m + s) P = −((x + h v − lag)/h)
        const double impulse = -((x + h * v - lag) / h) / (1 / m + soft);
        const double law = (m * v - h * k * x) / (m + h * k * tau + h * h * k);
        EXPECT_NEAR(v + impulse / m, law, 1e-11 * (1 + std::abs(law)));
    }
}

TEST(LineShare, IsNoneUpToARadianAndAllFromTheBound) {
    EXPECT_EQ(line_share(0), 0);
    EXPECT_EQ(line_share(1), 0);
    EXPECT_EQ(line_share(2), 0.5);
    EXPECT_EQ(line_share(3), 1);
    EXPECT_EQ(line_share(1e9), 1);
}

TEST(LineResponse, OfParticlesIsTheirInverseMasses) {
    LinkedPoint a, b;
    a.inverse.mass = 2, b.inverse.mass = 0.5;
    EXPECT_EQ(line_response(a, b, Vector3d::UnitX()), 2.5);
    // a body of inverse inertia 4 about z, pulled at 0.3 m from its centre
    b.inverse.inertia.zz = 4, b.arm = {0, 0.3, 0};
    EXPECT_NEAR(line_response(a, b, Vector3d::UnitX()), 2.5 + 4 * 0.09, 1e-15);
    EXPECT_NEAR(line_response(a, b, Vector3d::UnitY()), 2.5, 1e-15);
}

}  // namespace
}  // namespace plumb::test
