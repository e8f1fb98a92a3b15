// SPDX-License-Identifier: MIT
/// A lid that comes down on a heap, squeezes it into 70 % of what the bodies fill without any space
/// between them, stays, and opens again: no impulses can satisfy that, and none may be left in the
/// heap for it to fly apart. What the lid has left behind comes to rest as it would without it.
/// PLUMB_PRESSED_BODIES says how many (60).
#include "geometry/mass_properties.h"
#include "reader/shapes/polyhedra.h"
#include "support/binned_heap.h"
#include "support/environment.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

constexpr double kRadius = 0.05;  // of the bodies [m]
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

/// Into the bin, with a lid high above.
Scene boxed_heap(Scene s, const std::vector<Geometry>& shapes, std::uint32_t count) {
    add_bin(s, 4);
    add_body(s, box(kBinHalf, 0.2, kBinHalf), {0, 8, 0}, Motion::kinematic);
    add_layers(s, shapes, count);
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
        const double height = top(world), left = 0.7 * volume / (4 * kBinHalf * kBinHalf);
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
    const auto count = static_cast<std::uint32_t>(number_from("PLUMB_PRESSED_BODIES", 60));
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
        run_for(simulation, 6 + 0.1 * count);  // what is wedged settles in turns of a second
        EXPECT_LT(fastest(simulation.world()), 0.005) << "at rest again";
        for (std::uint32_t i = kFirst; i < kFirst + count; ++i) {
            const Vector& at = simulation.world().bodies.position[i];
            EXPECT_TRUE(std::abs(at.x()) < kBinHalf && std::abs(at.z()) < kBinHalf && at.y() > 0)
                << "body " << i << " is outside, at " << at.transpose();
        }
    }
}

/// Cubes are wedged between each other and the walls, with nowhere to go, in long substeps and
/// short ones: they rest as they are once what gives way has done so.
TEST_P(Press, WedgedCubesComeToRest) {
    const auto count = static_cast<std::uint32_t>(number_from("PLUMB_PRESSED_BODIES", 60));
    const PressedKind cubes = of_one("cubes", box(kRadius, kRadius, kRadius));
    Random random(29);
    for (int draw = 0; draw < 2; ++draw) {
        Scene s = boxed_heap(scene(), cubes.shapes, count);
        s.settings.dt = random.number(0.005, 0.02);
        s.settings.substeps = 1 + random.below(2);
        s.settings.velocity_iterations = 3 + random.below(8);
        s.settings.position_iterations = 3 + random.below(8);
        s.materials[0].friction = random.number(0.2, 1);
        SCOPED_TRACE("draw " + std::to_string(draw));
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 0.05 * count);
        press(simulation, count * cubes.volume);
        EXPECT_LT(most_, 5);
        run_for(simulation, 6 + 0.1 * count);
        EXPECT_LT(fastest(simulation.world()), 0.005);
    }
}

}  // namespace
}  // namespace plumb::test
