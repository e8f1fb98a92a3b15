// SPDX-License-Identifier: MIT
/// On which side of a sheet a corner of a body belongs.
#include "contacts/surface_detector.h"

#include "support/scenes.h"
#include "support/soft.h"
#include "world/edit_world.h"

namespace plumb::test {
namespace {

constexpr double kThick = 0.01;  // radius of the particles [m]

/// A box, turned so that one corner hangs lowest, over a sheet in the plane y = 0.
class ACornerOverASheet : public testing::Test {
protected:
    ACornerOverASheet() : simulation_(scene(), colliders(), "reference"), detector_(world()) {}

    World& world() { return const_cast<World&>(simulation_.world()); }

    /// The normal of the contact of the lowest corner, where that is at the given place; zero where
    /// there is none.
    Vector normal_at(const Vector& corner) {
        world().bodies.position[0] = corner + Vector(0, kLowest, 0);
        detector_.detect(world(), workers_, 0.01);
        for (const SurfaceContact& c : world().surface_contacts)
            if (c.point.body == 0 &&
                (in_world(world().bodies, 0, c.point.position) - corner).norm() < 1e-9)
                return c.normal;
        return Vector::Zero();
    }

private:
    static constexpr double kLowest = 0.17320508075688773;  // √3 × half a side

    static Scene scene() {
        Scene s;
        DeformableSpec cloth = sheet({10, 10}, {1, 1});
        cloth.radius = kThick;
        add_soft(s, std::move(cloth));
        add_body(s, box(0.1, 0.1, 0.1), {0, 1, 0}).placement.rotation =
            Rotation::FromTwoVectors(Vector(1, 1, 1), Vector(0, -1, 0));
        return s;
    }

    Simulation simulation_;
    Workers workers_{1};
    SurfaceDetector detector_;
};

TEST_F(ACornerOverASheet, IsPushedBackToWhereItCameFrom) {
    const Vector up(0, 1, 0);
    EXPECT_LT((normal_at({0.03, 0.004, 0.02}) - up).norm(), 1e-9);
    EXPECT_LT((normal_at({0.03, -0.002, 0.02}) - up).norm(), 1e-9) << "just beyond";
    EXPECT_LT((normal_at({0.05, -0.004, 0.02}) - up).norm(), 1e-9) << "beside, on the next one";
    EXPECT_LT((normal_at({0.05, 0.003, 0.02}) - up).norm(), 1e-9);
}

TEST_F(ACornerOverASheet, BelongsWhereItIsSeenFirst) {
    EXPECT_LT((normal_at({0.03, -0.004, 0.02}) - Vector(0, -1, 0)).norm(), 1e-9);
}

TEST_F(ACornerOverASheet, MayComeRoundTheRim) {
    EXPECT_GT(normal_at({0.45, 0.004, 0.02}).y(), 0.99);
    EXPECT_EQ(normal_at({0.8, 0, 0.02}), Vector::Zero()) << "nothing is near";
    EXPECT_LT(normal_at({0.45, -0.004, 0.02}).y(), -0.99);
}

TEST_F(ACornerOverASheet, IsForgottenWithItsBody) {
    EXPECT_GT(normal_at({0.03, 0.004, 0.02}).y(), 0.99);
    forget_contacts(world(), 0);
    EXPECT_LT(normal_at({0.03, -0.004, 0.02}).y(), -0.99);
}

}  // namespace
}  // namespace plumb::test
