// SPDX-License-Identifier: MIT
/// A lid that comes down on a heap, squeezes it into 70 % of what the bodies fill without any space
/// between them, stays, and opens again: no impulses can satisfy that, and none may be left in the
/// heap for it to fly apart. What the lid has left behind comes to rest as it would without it.
#include "geometry/mass_properties.h"
#include "reader/polyhedra.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace plumb::test {
namespace {

constexpr double kRadius = 0.05, kHalf = 0.27;  // of the bodies; of the box inside of its walls [m]
constexpr std::uint32_t kLid = 5, kFirst = 6;

/// Shapes of a radius of 0.05 m, and their mean volume [m³].
struct PressedKind {
    const char* name;
    std::vector<Geometry> shapes;
    double volume;
};

/// Hulls of points of a sphere, each another.
PressedKind hulls() {
    Random random(5);
    PressedKind pressed{"hulls", {}, 0};
    for (int k = 0; k < 5; ++k) {
        std::vector<Vector> points;
        for (int i = 0; i < 14; ++i) points.push_back(kRadius * random.direction());
        pressed.shapes.push_back(reader::hull_geometry(points));
        pressed.volume += mass_properties(pressed.shapes.back()).volume / 5;
    }
    return pressed;
}

PressedKind of_one(const char* name, const Geometry& shape) {
    return {name, {shape}, mass_properties(shape).volume};
}

/// How many bodies: 60, or as many as the environment asks for.
std::uint32_t body_count() {
    const char* const asked = std::getenv("PLUMB_PRESSED_BODIES");
    return asked ? static_cast<std::uint32_t>(std::atoi(asked)) : 60;
}

/// Four walls, a lid high above, and bodies in layers.
Scene boxed_heap(Scene s, const std::vector<Geometry>& shapes, std::uint32_t count) {
    s.materials[0].rolling_friction = 0.005;
    add_ground(s);
    for (const Vector& d : {Vector(1, 0, 0), Vector(-1, 0, 0), Vector(0, 0, 1), Vector(0, 0, -1)}) {
        const Vector half = Vector(kHalf + 0.4, 4, kHalf + 0.4) - (kHalf + 0.2) * d.cwiseAbs();
        add_body(s, box(half.x(), half.y(), half.z()), (kHalf + 0.2) * d + Vector(0, 4, 0),
                 Motion::fixed);
    }
    add_body(s, box(kHalf, 0.2, kHalf), {0, 8, 0}, Motion::kinematic);
    Random random(3);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double x = i % 3 - 1.0, z = (i / 3) % 3 - 1.0, layer = i / 9;
        BodySpec& body =
            add_body(s, shapes[i % shapes.size()], {0.175 * x, 0.1 + 0.18 * layer, 0.175 * z});
        body.placement.rotation = random.rotation();
    }
    return s;
}

double fastest(const World& world) {
    double speed = 0;
    for (std::uint32_t i = kFirst; i < world.bodies.size(); ++i)
        speed = std::max(speed, world.bodies.velocity[i].norm());
    return speed;
}

double top(const World& world) {
    double height = 0;
    for (std::uint32_t i = kFirst; i < world.bodies.size(); ++i)
        height = std::max(height, world.bodies.position[i].y() + kRadius);
    return height;
}

class Press : public OnEveryCollider {
protected:
    /// Presses and opens again; the greatest speed of a body meanwhile goes into `most_`.
    void press(Simulation& simulation, double volume) {
        constexpr double kSpeed = 0.5;  // of the lid [m/s]
        const World& world = simulation.world();
        most_ = 0;
        const auto move = [&](double speed, double seconds) {
            simulation.set_velocity(kLid, {0, speed, 0}, Vector::Zero());
            for (const double end = simulation.time() + seconds; simulation.time() < end;) {
                ASSERT_TRUE(simulation.step().finite);
                most_ = std::max(most_, fastest(world) - kSpeed);
            }
        };
        const double height = top(world), left = 0.7 * volume / (4 * kHalf * kHalf);
        Placement lid;
        lid.position = {0, height + 0.25, 0};
        simulation.set_placement(kLid, lid);
        const double down = (height + 0.05 - left) / kSpeed;
        move(-kSpeed, down), move(0, 0.3), move(kSpeed, 2 * down), move(0, 0.01);
    }

    double most_ = 0;
};
INSTANTIATE_TEST_SUITE_P(, Press, every_collider(), where_name);

TEST_P(Press, LeavesNothingToFlyApart) {
    const std::uint32_t count = body_count();
    const PressedKind kinds[] = {
        of_one("cubes", box(kRadius, kRadius, kRadius)), of_one("balls", sphere(kRadius)),
        of_one("capsules", capsule(0.7 * kRadius, 0.6 * kRadius)), hulls()};
    for (const PressedKind& kind : kinds) {
        const ShapeKind shape = kind.shapes[0].kind;
        if ((shape == ShapeKind::capsule || shape == ShapeKind::hull) && collider() == "reference")
            continue;
        SCOPED_TRACE(kind.name);
        Simulation simulation(boxed_heap(scene(), kind.shapes, count), colliders(), collider());
        run_for(simulation, 0.05 * count);  // higher heaps take longer to fall and to settle
        press(simulation, count * kind.volume);
        EXPECT_LT(most_, 5);
        run_for(simulation, 0.1 * count);
        EXPECT_LT(fastest(simulation.world()), 0.005) << "at rest again";
        for (std::uint32_t i = kFirst; i < kFirst + count; ++i) {
            const Vector& at = simulation.world().bodies.position[i];
            EXPECT_TRUE(std::abs(at.x()) < kHalf && std::abs(at.z()) < kHalf && at.y() > 0)
                << "body " << i << " is outside, at " << at.transpose();
        }
    }
}

}  // namespace
}  // namespace plumb::test
