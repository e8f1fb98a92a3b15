// SPDX-License-Identifier: MIT
/// Heaps that something of infinite mass hits: who moves along with it sees no energy that was not
/// there, whatever the masses, the restitution and the step. Without friction.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

class Pushers : public OnEveryCollider {
protected:
    /// A heap of balls and boxes that touch, or nearly, with masses 1 to `heaviest`.
    Scene heap(Random& random, std::uint32_t bodies, double heaviest, const Vector& corner) const {
        constexpr double kSize = 0.1;
        Scene s = scene();
        s.settings.gravity.setZero();
        s.materials[0].friction = 0;
        s.materials[0].restitution = random.below(3) == 0 ? random.number(0, 1) : 1;
        const double pitch = 2 * kSize + (random.below(2) == 0 ? 0 : random.number(0, 0.05));
        const std::uint32_t depth = 1 + random.below(4);
        for (std::uint32_t i = 0; i < bodies; ++i) {
            const Vector cell(i % 4, i / (4 * depth), i / 4 % depth);
            BodySpec& body =
                add_body(s, random.below(2) == 0 ? sphere(kSize) : box(kSize, kSize, kSize),
                         corner + pitch * cell);
            body.mass = std::pow(heaviest, random.number(0, 1));
        }
        return s;
    }
};
INSTANTIATE_TEST_SUITE_P(, Pushers, every_collider(), where_name);

/// Of the bodies, and what it is to one who moves with the pusher, which goes at v [m/s] and turns
/// at w [rad/s] about the origin [J]: E − v·P − w·L, but for a constant.
struct Energies {
    double own, seen;

    Energies(const World& world, const Vector& v, const Vector& w)
        : own(kinetic_energy(world)),
          seen(own - v.dot(linear_momentum(world)) - w.dot(angular_momentum(world))) {}
};

/// A wall that goes on, or a paddle that turns about the origin.
TEST_P(Pushers, GiveNoMoreThanTheirWork) {
    Random random(61);
    for (int draw = 0; draw < 60; ++draw) {
        const bool turns = draw % 2 == 1;
        const double speed = random.number(0.3, 6);
        Scene s = heap(random, 1 + random.below(30), std::pow(10, random.number(0, 4)),
                       turns ? Vector(0.45, 0, 0.25) : Vector::Zero());
        BodySpec& pusher =
            turns ? add_body(s, box(2, 2, 0.1), Vector::Zero(), Motion::kinematic)
                  : add_body(s, box(0.1, 2, 2), Vector(-0.25, 0, 0), Motion::kinematic);
        if (turns)
            pusher.angular_velocity = {0, -speed, 0};
        else
            pusher.velocity = {speed, 0, 0};
        const Vector v = pusher.velocity, w = pusher.angular_velocity;
        draw_settings(s.settings, random, draw / 2);
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << s.bodies.size()
                                        << " bodies, e " << s.materials[0].restitution << ", "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        const World& world = simulation.world();
        double moving = 0, most = 0;
        while (simulation.time() < 1.5 / speed) {
            ASSERT_TRUE(simulation.step().finite);
            const Energies now(world, v, w);
            moving = std::max(moving, now.own), most = std::max(most, now.seen);
        }
        EXPECT_GT(moving, 0) << "was not hit";
        EXPECT_LT(most, 1e-3 * moving);
    }
}

/// What is pressed against a wall has nowhere to go: no impulses would do, and those that
/// iterations come to are not to throw anything.
TEST_P(Pushers, FlingNothingOutThatTheyCrush) {
    Random random(63);
    for (int draw = 0; draw < 12; ++draw) {
        const double speed = random.number(0.3, 6);
        Scene s =
            heap(random, 4 + random.below(10), std::pow(10, random.number(0, 3)), Vector::Zero());
        if (draw % 2 == 0) s.materials[0].restitution = 0;
        add_body(s, box(0.5, 3, 3), {1.5, 0, 0}, Motion::fixed);
        add_body(s, box(0.1, 1, 1), {-0.25, 0, 0}, Motion::kinematic).velocity = {speed, 0, 0};
        draw_settings(s.settings, random, draw / 2);
        Simulation simulation(s, colliders(), collider());
        double fastest = 0;
        while (simulation.time() < 1 / speed) {
            ASSERT_TRUE(simulation.step().finite);
            const std::vector<Vector>& v = simulation.world().bodies.velocity;
            for (const Vector& of : v) fastest = std::max(fastest, of.norm());
        }
        EXPECT_LT(fastest, 100 * speed) << "draw " << draw << ", " << s.bodies.size() << " bodies";
    }
}

/// What is hit leaves at (1 + e) times the speed of what hits it.
TEST_P(Pushers, ThrowABallByItsLaw) {
    Random random(62);
    for (int draw = 0; draw < 12; ++draw) {
        const double e = random.number(0, 1), speed = random.number(0.5, 5);
        Scene s = scene();
        s.settings.gravity.setZero();
        s.materials[0].friction = 0, s.materials[0].restitution = e;
        add_body(s, sphere(0.1), Vector::Zero()).mass = random.number(0.1, 10);
        add_body(s, box(0.1, 1, 1), {-0.3, 0, 0}, Motion::kinematic).velocity = {speed, 0, 0};
        draw_settings(s.settings, random, draw);
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 0.15 / speed);
        EXPECT_NEAR(simulation.world().bodies.velocity[0].x() / speed, 1 + e, 1e-3)
            << "draw " << draw;
    }
}

}  // namespace
}  // namespace plumb::test
