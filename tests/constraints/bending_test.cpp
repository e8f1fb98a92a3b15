// SPDX-License-Identifier: MIT
/// Bending about an edge: weights of flat hinges, and angles of bent ones.
#include "constraints/bending.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plumb {
namespace {

using test::Random;

/// Two triangles (0, 1, 2) and (1, 0, 3) about the edge from 0 to 1, bent by θ: a ridge, seen from
/// where they run counter-clockwise, where it is positive.
struct Hinge {
    double length, height[2], along[2];

    explicit Hinge(Random& random) {
        length = random.number(0.5, 2);
        for (int i = 0; i < 2; ++i)
            height[i] = random.number(0.3, 1.5), along[i] = random.number(-0.2, 0.8) * length;
    }
    void place(double angle, Vector3d (&p)[4]) const {
        p[0] = {0, 0, 0}, p[1] = {length, 0, 0};
        p[2] = {along[0], height[0], 0};
        p[3] = {along[1], -height[1] * std::cos(angle), -height[1] * std::sin(angle)};
    }
    double area() const { return 0.5 * length * (height[0] + height[1]); }

    DeformableSpec spec(double angle) const {
        DeformableSpec s;
        Vector3d p[4];
        place(angle, p);
        s.points.assign(p, p + 4);
        s.triangles = {{0, 1, 2}, {1, 0, 3}};
        s.elasticity.bending_stiffness = 0.1;
        return s;
    }
};

Deformable deformable(const DeformableSpec& spec) { return {spec, 0, 4}; }

TEST(IsometricBend, WeightsAnnihilateLinearFunctions) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Hinge hinge(random);
        const DeformableSpec spec = hinge.spec(0);
        int seen = 0;
        IsometricBend::each(deformable(spec),
                            [&](const auto& at, const double(&weights)[4], double compliance) {
                                double sum = 0;
                                Vector3d moment = Vector3d::Zero();
                                for (int k = 0; k < 4; ++k)
                                    sum += weights[k], moment += weights[k] * spec.points[at[k]];
                                EXPECT_NEAR(sum, 0, 1e-12);
                                EXPECT_LT(moment.norm(), 1e-12);
                                EXPECT_NEAR(compliance, hinge.area() / 0.1, 1e-12);
                                ++seen;
                            });
        EXPECT_EQ(seen, 1);
        DihedralBend::each(deformable(spec), [&](auto&&...) { ADD_FAILURE() << "it is flat"; });
    }
}

TEST(IsometricBend, IsLengthTimesAngleOfSmallHinges) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const Hinge hinge(random);
        const double angle = random.number(-1e-3, 1e-3);
        const Quaterniond turn = random.rotation();
        Vector3d p[4], c = Vector3d::Zero();
        hinge.place(angle, p);
        IsometricBend::each(deformable(hinge.spec(0)),
                            [&](const auto& at, const double(&weights)[4], double) {
                                for (int k = 0; k < 4; ++k) c += weights[k] * (turn * p[at[k]]);
                            });
        EXPECT_NEAR(c.norm(), hinge.length * std::abs(angle), 1e-6 * hinge.length);
    }
}

/// C = 2 sin ½(θ − θ₀) from nearly half a turn one way to nearly half a turn the other way.
TEST(DihedralBend, GrowsUpToHalfATurnBothWays) {
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const Hinge hinge(random);
        const double rest = random.number(-3.1, 3.1), apart = random.number(-3.1, 3.1);
        const Quaterniond turn = random.rotation();
        Vector3d p[4];
        hinge.place(rest + apart, p);
        for (Vector3d& x : p) x = turn * x;
        const double numbers[2] = {std::sin(rest), std::cos(rest)};
        const auto rows = DihedralBend::rows(p, numbers);
        EXPECT_NEAR(rows.c[0], 2 * std::sin(apart / 2), 1e-9) << apart;
    }
}

TEST(DihedralBend, RestIsTheAngleOfThePoints) {
    Random random(4);
    for (const double angle : {-3.0, -1.0, -1e-4, 1e-4, 0.5, 3.0}) {
        const Hinge hinge(random);
        int seen = 0;
        DihedralBend::each(
            deformable(hinge.spec(angle)),
            [&](const auto&, const double(&numbers)[2], const double(&compliances)[1]) {
                EXPECT_NEAR(numbers[0], std::sin(angle), 1e-12);
                EXPECT_NEAR(numbers[1], std::cos(angle), 1e-12);
                EXPECT_NEAR(compliances[0], hinge.area() / (0.1 * hinge.length * hinge.length),
                            1e-9 * compliances[0]);
                ++seen;
            });
        EXPECT_EQ(seen, 1) << angle;
    }
}

/// A step down the gradient brings the hinge nearer to its rest, whichever way it is bent.
TEST(DihedralBend, PushesTowardsItsRest) {
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const Hinge hinge(random);
        const double rest = random.number(-3.1, 3.1), apart = random.number(-3.1, 3.1);
        if (std::abs(apart) < 0.01) continue;
        Vector3d p[4];
        hinge.place(rest + apart, p);
        const double numbers[2] = {std::sin(rest), std::cos(rest)};
        const auto rows = DihedralBend::rows(p, numbers);
        double size = 0;
        for (const Vector3d& g : rows.gradient[0]) size += g.squaredNorm();
        const double step = 1e-5 / std::sqrt(size);
        for (int k = 0; k < 4; ++k) p[k] -= rows.gradient[0][k] * (rows.c[0] > 0 ? step : -step);
        const bending::EdgeAngle angle = bending::angle_at(p);
        const double now =
            std::remainder(std::atan2(angle.sine, angle.cosine) - rest, 2 * std::numbers::pi);
        EXPECT_LT(std::abs(now), std::abs(apart));
        EXPECT_EQ(rows.c[0] > 0, apart > 0);
    }
}

}  // namespace
}  // namespace plumb
