// SPDX-License-Identifier: MIT
/// On which side of a sheet a corner of a body belongs, and what of a solid is held off itself.
#include "contacts/surface_detector.h"

#include "support/scenes.h"
#include "support/soft.h"
#include "world/edit_world.h"

#include <cmath>
#include <vector>

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

/// A solid whose points are where `place` takes them: the points that are held off its own surface,
/// by where they are at rest.
template <class Place>
std::vector<Vector> held_off(DeformableSpec solid, Place place) {
    Scene s;
    s.settings.gravity.setZero();
    solid.radius = kThick;
    const std::vector<Vector> rest = add_soft(s, std::move(solid)).points;
    const Simulation simulation(s, colliders(), "reference");
    World& world = const_cast<World&>(simulation.world());
    for (std::size_t i = 0; i < rest.size(); ++i) world.particles.position[i] = place(rest[i]);
    Workers workers(1);
    SurfaceDetector(world).detect(world, workers, 0.01);
    std::vector<Vector> held;
    for (const SurfaceContact& c : world.surface_contacts) held.push_back(rest[c.point.particle]);
    return held;
}

TEST(ASolid, IsNotHeldOffWhatIsBehindItsSurface) {
    for (const double share : {0.0, 0.01, -0.5})
        for (const Vector& half : {Vector(0.2, 0.15, 0.2), Vector(0.1, 0.2, 0.1)}) {
            const auto crushed = [&](const Vector& p) {
                return Vector(p.x(), share * p.y(), p.z());
            };
            EXPECT_TRUE(held_off(block(half, {4, 4, 4}), crushed).empty()) << share;
        }
}

/// A mat, 1 m by 0.1 m by 0.3 m, folded over its top by half a turn.
TEST(ASolid, IsHeldOffAFaceThatIsFoldedOntoIt) {
    const auto folded = [](const Vector& p) {
        return p.x() > 0 ? Vector(-p.x(), 0.115 - p.y(), p.z()) : p;
    };
    const std::vector<Vector> held = held_off(block({0.5, 0.05, 0.15}, {20, 2, 6}), folded);
    int left = 0, right = 0;
    for (const Vector& p : held) {
        if (p.y() < 0.049 || std::abs(p.x()) < 0.25) continue;
        ++(p.x() > 0 ? right : left);
    }
    EXPECT_GT(left, 20);
    EXPECT_GT(right, 20);
}

}  // namespace
}  // namespace plumb::test
