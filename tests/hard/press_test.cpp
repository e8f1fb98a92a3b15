// SPDX-License-Identifier: MIT
/// A lid that comes down on a heap, squeezes it into 70 % of its height, stays, and opens again: no
/// impulses can satisfy that, and none may be left in the heap for it to fly apart.
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

constexpr double kRadius = 0.05, kHalf = 0.25;  // of the bodies; of the box inside of its walls [m]
constexpr std::uint32_t kBodies = 100, kLid = 5, kFirst = 6;

/// Four walls, a lid high above, and a hundred bodies in layers.
Scene boxed_heap(Scene s, const Geometry& shape) {
    s.materials[0].rolling_friction = 0.005;
    add_ground(s);
    for (const Vector& d : {Vector(1, 0, 0), Vector(-1, 0, 0), Vector(0, 0, 1), Vector(0, 0, -1)}) {
        const Vector half = Vector(kHalf + 0.4, 2, kHalf + 0.4) - (kHalf + 0.2) * d.cwiseAbs();
        add_body(s, box(half.x(), half.y(), half.z()), (kHalf + 0.2) * d + Vector(0, 2, 0),
                 Motion::fixed);
    }
    add_body(s, box(kHalf, 0.2, kHalf), {0, 4, 0}, Motion::kinematic);
    for (std::uint32_t i = 0; i < kBodies; ++i) {
        const double x = i % 4 - 1.5, z = (i / 4) % 4 - 1.5, layer = i / 16;
        BodySpec& body = add_body(s, shape, {0.115 * x, 0.06 + 0.12 * layer, 0.115 * z});
        body.placement.rotation =
            Rotation(Eigen::AngleAxisd(0.1 * (i % 7), Vector(1, 0.3 * (i % 3), 0.5).normalized()));
    }
    return s;
}

double fastest(const World& world) {
    double speed = 0;
    for (std::uint32_t i = kFirst; i < kFirst + kBodies; ++i)
        speed = std::max(speed, world.bodies.velocity[i].norm());
    return speed;
}

/// How many bodies move faster than 5 cm/s.
std::uint32_t moving(const World& world) {
    std::uint32_t count = 0;
    for (std::uint32_t i = kFirst; i < kFirst + kBodies; ++i)
        count += world.bodies.velocity[i].norm() > 0.05;
    return count;
}

double top(const World& world) {
    double height = 0;
    for (std::uint32_t i = kFirst; i < kFirst + kBodies; ++i)
        height = std::max(height, world.bodies.position[i].y() + kRadius);
    return height;
}

class Press : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Press, every_collider(), where_name);

TEST_P(Press, LeavesNothingToFlyApart) {
    constexpr double kSpeed = 0.5;  // of the lid [m/s]
    for (const Geometry& shape :
         {box(kRadius, kRadius, kRadius), sphere(kRadius), capsule(0.7 * kRadius, 0.6 * kRadius)}) {
        if (shape.kind == ShapeKind::capsule && collider() == "reference") continue;
        SCOPED_TRACE(static_cast<int>(shape.kind));
        Simulation simulation(boxed_heap(scene(), shape), colliders(), collider());
        const World& world = simulation.world();
        run_for(simulation, 2);
        const double height = top(world);
        Placement lid;
        lid.position = {0, height + 0.25, 0};
        simulation.set_placement(kLid, lid);
        double most = 0;
        const auto press = [&](double speed, double seconds) {
            simulation.set_velocity(kLid, {0, speed, 0}, Vector::Zero());
            for (const double end = simulation.time() + seconds; simulation.time() < end;) {
                ASSERT_TRUE(simulation.step().finite);
                most = std::max(most, fastest(world));
            }
        };
        const double down = (0.3 * height + 0.05) / kSpeed;
        press(-kSpeed, down), press(0, 0.3), press(kSpeed, 2 * down), press(0, 8);
        EXPECT_LT(most, kSpeed + 5);
        EXPECT_LE(moving(world), kBodies / 20) << "at rest again, but for what still rolls";
        for (std::uint32_t i = kFirst; i < kFirst + kBodies; ++i) {
            const Vector& at = world.bodies.position[i];
            EXPECT_TRUE(std::abs(at.x()) < kHalf && std::abs(at.z()) < kHalf && at.y() > 0)
                << "body " << i << " is outside, at " << at.transpose();
        }
    }
}

}  // namespace
}  // namespace plumb::test
