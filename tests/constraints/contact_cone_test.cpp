// SPDX-License-Identifier: MIT
/// The cone of contact: nearest points by their definition, the derivative by differences, the law
/// by cases of which the answer is known.
#include "constraints/contact_cone.h"
#include "support/random.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

using test::Random;

Vector6d random_vector(Random& random, double size) {
    Vector6d z;
    for (auto& x : z) x = random.number(-size, size);
    return z;
}
ContactCone random_cone(Random& random) {
    const auto lever = [&](double most) {
        return random.below(4) == 0 ? 0 : random.number(0, most);
    };
    return {lever(2), lever(1), lever(1), random.below(2) ? 0.7 : 1e3};
}
/// Any point of the cone.
Vector6d random_point(Random& random, const ContactCone& c) {
    return lawful_step(random_vector(random, 2), Vector6d::Zero(), 1, c);
}
bool holds(const Vector6d& z, const ContactCone& c) {
    const std::array<double, 3> length = cone_lengths(z);
    const double slack = 1e-12;
    return z[0] >= 0 && z[0] <= c.most && length[0] <= c.friction * z[0] + slack &&
           length[1] <= c.spinning * z[0] + slack && length[2] <= c.rolling * z[0] + slack;
}

/// p is nearest to z in a convex set where no other point of it lies further towards z.
TEST(ContactCone, FindsTheNearestPoint) {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const ContactCone c = random_cone(random);
        const Vector6d z = random_vector(random, 2);
        const Vector6d p = nearest_on_cone(z, c).impulse;
        ASSERT_TRUE(holds(p, c)) << z.transpose();
        for (int k = 0; k < 20; ++k)
            ASSERT_LE((z - p).dot(random_point(random, c) - p), 1e-9) << z.transpose();
    }
}

TEST(ContactCone, LeavesItsOwnPointsAlone) {
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const ContactCone c = random_cone(random);
        const Vector6d p = random_point(random, c) * 0.999;
        EXPECT_LT((nearest_on_cone(p, c).impulse - p).norm(), 1e-12);
    }
}

/// Three numbers do for what nothing keeps from turning.
TEST(ContactCone, IsTheSameInThreeNumbersWhereNothingResistsTurning) {
    Random random(7);
    for (int i = 0; i < 500; ++i) {
        ContactCone c = random_cone(random);
        c.spinning = c.rolling = 0;
        Vector6d z = random_vector(random, 2), lack = random_vector(random, 2);
        z.tail<3>().setZero(), lack.tail<3>().setZero();
        const Vector3d z3 = z.head<3>(), lack3 = lack.head<3>();
        const auto six = nearest_on_cone(z, c);
        const auto three = nearest_on_cone(z3, c);
        EXPECT_EQ(three.impulse, six.impulse.head<3>());
        EXPECT_EQ(three.inside(), six.inside());
        const Matrix3d of_six = cone_derivative(z, six, c).topLeftCorner<3, 3>();
        EXPECT_LT((cone_derivative(z3, three, c) - of_six).norm(), 1e-14);
        EXPECT_EQ(lawful_step(z3, lack3, 2, c), lawful_step(z, lack, 2, c).head<3>());
        EXPECT_EQ(slip_shift(three.impulse, lack3, 0.1, c), slip_shift(six.impulse, lack, 0.1, c));
    }
}

TEST(ContactCone, HasTheDerivativeOfItsNearestPoint) {
    Random random(3);
    const double step = 1e-6;
    int compared = 0;
    for (int i = 0; i < 500; ++i) {
        const ContactCone c = random_cone(random);
        const Vector6d z = random_vector(random, 2);
        const ConePoint at = nearest_on_cone(z, c);
        Matrix6d expected;
        bool smooth = true;
        for (int k = 0; k < 6; ++k) {
            const Vector6d d = step * Vector6d::Unit(k);
            const ConePoint up = nearest_on_cone(z + d, c), down = nearest_on_cone(z - d, c);
            for (const auto& p : {up, down})
                smooth &= p.pushes == at.pushes && p.slides == at.slides && p.spins == at.spins &&
                          p.rolls == at.rolls && p.strained == at.strained;
            expected.col(k) = (up.impulse - down.impulse) / (2 * step);
        }
        if (!smooth) continue;
        ++compared;
        EXPECT_LT((cone_derivative(z, at, c) - expected).cwiseAbs().maxCoeff(), 1e-6);
    }
    EXPECT_GT(compared, 400);
}

TEST(ContactCone, TheLawHoldsWhereAndOnlyWhereItShould) {
    const ContactCone c{0.5, 0, 0, 1e3};
    const auto change = [&](const Vector6d& impulse, const Vector6d& lack) {
        return (lawful_step(impulse, lack, 2, c) - impulse).norm();
    };
    Vector6d sticks, slides, parts = Vector6d::Zero(), lack = Vector6d::Zero();
    sticks << 1, 0.3, 0.3, 0, 0, 0;
    slides << 1, 0.5, 0, 0, 0, 0;
    EXPECT_EQ(change(sticks, lack), 0);
    lack << 0, 0.7, 0, 0, 0, 0;  // it slides against x, where friction pushes it to
    EXPECT_NEAR(change(slides, lack), 0, 1e-15);
    EXPECT_GT(change(sticks, lack), 0.1);
    lack << -0.4, 0, 0, 0, 0, 0;  // it parts
    EXPECT_EQ(change(parts, lack), 0);
    EXPECT_GT(change(sticks, lack), 0.1);
    lack << 0.4, 0, 0, 0, 0, 0;  // it approaches
    EXPECT_GT(change(parts, lack), 0.1);
}

TEST(ContactCone, SlipBeyondTheSlackLiftsByFriction) {
    const ContactCone c{0.5, 0, 0, 1e3};
    Vector6d slides, slip = Vector6d::Zero();
    slides << 1, 0.5, 0, 0, 0, 0;
    slip[1] = 3;
    EXPECT_DOUBLE_EQ(slip_shift(slides, slip, 1, c), 0.5 * (3 - 1));
    EXPECT_EQ(slip_shift(slides, slip, 4, c), 0);
    EXPECT_EQ(slip_shift(0.9 * slides + Vector6d::Unit(0), slip, 1, c), 0);  // it sticks
}

}  // namespace
}  // namespace plumb
