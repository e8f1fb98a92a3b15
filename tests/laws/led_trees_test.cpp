// SPDX-License-Identifier: MIT
/// Light rods under a load that hang by a hand which a script leads. Seen from a hand that moves or
/// turns evenly nothing gives them energy; one that shakes does, as much as the finest steps say.
#include "math/rotation.h"
#include "support/pendulum.h"
#include "support/random.h"
#include "support/scenes.h"
#include "world/body_momentum.h"
#include "world/motion_script.h"

#include <cmath>
#include <functional>

namespace plumb::test {
namespace {

class LedTrees : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, LedTrees, each_precision(), precision_name);

constexpr JointKind kKinds[] = {JointKind::ball, JointKind::hinge, JointKind::universal};

/// A hand alone, by its poses at times that are `between` apart [s]; nothing touches.
Scene led_hand(Precision precision, const std::function<Placement(double)>& way, double until,
               double between) {
    Scene s;
    s.settings.precision = precision;
    s.settings.forbid = {"contacts"};
    BodySpec& hand = add_body(s, sphere(0.02), way(0).position);
    hand.motion = Motion::kinematic;
    for (double time = 0; time < until + between; time += between)
        hand.script.keyframes.push_back({time, way(time)});
    return s;
}
Scene led_hand(Precision precision, const std::function<Vector(double)>& way, double until,
               double between) {
    return led_hand(
        precision,
        [&](double time) {
            return Placement{way(time), Rotation::Identity()};
        },
        until, between);
}

/// At 10 ms undivided, at 1/60 s in 20 substeps, and at what is drawn.
void draw_steps(Settings& settings, int draw, Random& random) {
    if (draw % 3 == 1) use_fine_steps(settings);
    if (draw % 3 == 2)
        settings.dt = random.number(0.002, 0.02), settings.substeps = 1 + random.below(20);
}

/// A line of rods, each of 1 kg but for the last.
struct Rods {
    std::uint32_t count = 2;
    double length = 0.1, thickness = 0.01;  ///< of one [m]
    double angle = 0;                       ///< from straight down, to +x [rad]
    double load = 30;                       ///< mass of the last [kg]
    JointKind kind = JointKind::ball;

    Vector along() const { return {std::sin(angle), -std::cos(angle), 0}; }
};

Rods drawn_rods(Random& random) {
    Rods rods;
    rods.count = 2 + random.below(3);
    rods.length = random.number(0.05, 0.2), rods.thickness = random.number(0.05, 0.2) * rods.length;
    rods.angle = random.number(0.1, 1);
    rods.load = std::pow(10, random.number(1, 2));
    rods.kind = kKinds[random.below(3)];
    return rods;
}

/// From a point of the hand on, at a velocity of all and a rate about the world's origin.
void hang(Scene& s, const Rods& rods, const Vector& at, const Vector& velocity,
          const Vector& rate = Vector::Zero()) {
    const Vector along = rods.along();
    for (std::uint32_t i = 0; i < rods.count; ++i) {
        JointSpec joint;
        joint.body_a = static_cast<std::uint32_t>(s.bodies.size());
        joint.body_b = i > 0 ? joint.body_a - 1 : 0;
        joint.kind = rods.kind, joint.anchor = at + along * rods.length * i;
        if (joint.kind == JointKind::hinge)
            joint.frame = rotation_between(Vector::UnitX(), Vector::UnitZ());
        BodySpec& body = add_body(s, box(rods.thickness, 0.5 * rods.length, 0.7 * rods.thickness),
                                  at + along * rods.length * (i + 0.5));
        body.mass = i + 1 < rods.count ? 1 : rods.load;
        body.placement.rotation = rotation_between(-Vector::UnitY(), along);
        body.velocity = velocity + rate.cross(body.placement.position);
        body.angular_velocity = rate;
        s.joints.push_back(joint);
    }
}

/// How much higher the rods are than if they hung straight down, and their energy seen by who moves
/// along with a velocity, or turns about the vertical axis through the origin at a rate [J].
double energy_seen(const Simulation& simulation, double hand_height, const Rods& rods,
                   const Vector& velocity, double rate) {
    const World& world = simulation.world();
    const Bodies& b = world.bodies;
    double energy = 0, depth = 0;
    for (std::size_t i = 1; i < b.size(); ++i) {
        const Vector v = b.velocity[i] - velocity;
        depth = hand_height - (static_cast<double>(i) - 0.5) * rods.length;
        energy += kinetic_energy(b, i, v, b.angular_velocity[i]) +
                  kGravity * b.mass[i] * (b.position[i].y() - depth);
        const Vector momentum = b.mass[i] * b.position[i].cross(b.velocity[i]) +
                                spin_momentum(b, i, b.angular_velocity[i]);
        energy -= rate * momentum.y();
    }
    return energy;
}

/// What is seen changes little in 12 s, against the greatest energy of motion [J/J], or the step
/// says that it could not follow; and by no means much.
void expect_kept(const Scene& s, const Rods& rods, const Vector& velocity, double rate) {
    Simulation simulation(s, colliders(), "reference");
    const double height = s.bodies[0].placement.position.y();
    double first = 0, last = 0, moving = 0;
    int of_first = 0, of_last = 0;
    std::uint32_t coarse = 0, open = 0;
    while (simulation.time() < 12) {
        const StepReport report = simulation.step();
        ASSERT_TRUE(report.finite);
        coarse += report.coarse_trees, open += report.unsolved_trees;
        const double hand = height + velocity.y() * simulation.time();
        const double energy = energy_seen(simulation, hand, rods, velocity, rate);
        double now = 0;
        const Bodies& b = simulation.world().bodies;
        for (std::size_t i = 1; i < b.size(); ++i)
            now += kinetic_energy(b, i, b.velocity[i] - velocity, b.angular_velocity[i]);
        moving = std::max(moving, now);
        if (simulation.time() < 2) first += energy, ++of_first;
        if (simulation.time() > 10) last += energy, ++of_last;
    }
    EXPECT_EQ(open, 0u);
    const double gained = (last / of_last - first / of_first) / moving;
    EXPECT_TRUE(std::abs(gained) < 0.01 || coarse > 0) << gained << " without a word";
    EXPECT_NEAR(gained, 0, 0.05);
}

TEST_P(LedTrees, SwingOnAHandThatMovesEvenly) {
    Random random(GetParam() == Precision::single ? 51 : 52);
    for (int draw = 0; draw < 12; ++draw) {
        const Vector velocity = random.number(0.5, 3) * random.direction();
        Scene s = led_hand(
            GetParam(), [&](double time) -> Vector { return time * velocity; }, 13, 13);
        draw_steps(s.settings, draw, random);
        const Rods rods = drawn_rods(random);
        hang(s, rods, Vector::Zero(), velocity);
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << rods.count << " rods, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        expect_kept(s, rods, velocity, 0);
    }
}

/// A joint that keeps a turn hands on what the hand turns by.
TEST_P(LedTrees, SwingOnAHandThatTurnsEvenly) {
    Random random(GetParam() == Precision::single ? 53 : 54);
    for (int draw = 0; draw < 12; ++draw) {
        const double rate = random.number(-8, 8);
        const Vector at(random.number(0, 0.2), 0, random.number(-0.1, 0.1));
        const auto way = [&](double time) {
            return Placement{Vector::Zero(), exponential_map(rate * time * Vector::UnitY())};
        };
        Scene s = led_hand(GetParam(), way, 13, 0.1);
        draw_steps(s.settings, draw, random);
        const Rods rods = drawn_rods(random);
        hang(s, rods, at, Vector::Zero(), rate * Vector::UnitY());
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << rods.count << " rods, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        expect_kept(s, rods, Vector::Zero(), rate);
    }
}

/// Σ m r² and Σ m r of rods in a line, about the point that they hang by.
struct Moments {
    double inertia = 0, first = 0;

    Moments(const World& world, const Vector& at) {
        const Bodies& b = world.bodies;
        for (std::size_t i = 1; i < b.size(); ++i) {
            const double r = (b.position[i] - at).norm();
            inertia += b.mass[i] * r * r + b.inertia[i].maxCoeff();
            first += b.mass[i] * r;
        }
    }
};

/// Two rods under so great a load that they swing as one.
Rods two_rods(double angle) { return {2, 0.15, 0.02, angle, 5000, JointKind::ball}; }

/// In the hand's frame gravity is askew, and greater.
TEST_P(LedTrees, HaveTheirPeriodOnAHandThatGetsEvenlyFaster) {
    Random random(55);
    for (int draw = 0; draw < 6; ++draw) {
        const double a = random.number(2, 8), swing = random.number(0.1, 0.6);
        Scene s = led_hand(
            GetParam(),
            [&](double time) -> Vector {
                return {0.5 * a * time * time, 0, 0};
            },
            8, 0.01);
        draw_steps(s.settings, draw, random);
        const double tilt = std::atan2(-a, kGravity);
        hang(s, two_rods(tilt + swing), Vector::Zero(), Vector::Zero());
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        const Moments moments(world, Vector::Zero());
        const double weight = std::hypot(kGravity, a);
        const double exact = 2 * std::numbers::pi * lengthening(swing) *
                             std::sqrt(moments.inertia / (weight * moments.first));
        const Vector across(std::cos(tilt), std::sin(tilt), 0);
        PeriodWatch watch;
        double widest = 0;
        while (simulation.time() < 7) {
            simulation.step();
            const Vector from_hand = world.bodies.position[2] - world.bodies.position[0];
            watch.see(simulation.time(), s.settings.dt, across.dot(from_hand));
            widest = std::max(widest, std::abs(across.dot(from_hand)) / from_hand.norm());
        }
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ", " << s.settings.dt << " s x " << s.settings.substeps);
        EXPECT_NEAR(watch.period() / exact, 1, 0.005);
        EXPECT_NEAR(widest / std::sin(swing), 1, 0.01);
    }
}

/// A hand to and fro swings what hangs by it as far as theory says, in its time or against it.
TEST_P(LedTrees, SwingWithAHandThatGoesToAndFro) {
    Random random(56);
    for (int draw = 0; draw < 6; ++draw) {
        const double far = random.number(0.005, 0.01);
        const double rate = 2 * std::numbers::pi * (draw < 3 ? random.number(0.4, 0.6) : 2);
        Scene s = led_hand(
            GetParam(),
            [&](double time) -> Vector {
                return {far * std::sin(rate * time), 0, 0};
            },
            11, 0.002);
        draw_steps(s.settings, draw, random);
        hang(s, two_rods(0), Vector::Zero(), Vector::Zero());
        Scene still = s;
        const Moments moments(Simulation(still, colliders(), "reference").world(), Vector::Zero());
        const double own = kGravity * moments.first / moments.inertia;  // rate squared
        const double angle =
            moments.first / moments.inertia * far * rate * rate / (own - rate * rate);
        // as if it had always swung so
        for (std::size_t i = 1; i < s.bodies.size(); ++i) {
            s.bodies[i].angular_velocity = {0, 0, rate * angle};
            s.bodies[i].velocity.x() =
                far * rate - rate * angle * s.bodies[i].placement.position.y();
        }
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ", " << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), "reference");
        const Bodies& b = simulation.world().bodies;
        double off = 0;
        while (simulation.time() < 10) {
            simulation.step();
            const Vector from_hand = b.position[2] - b.position[0];
            const double exact = angle * std::sin(rate * simulation.time());
            off = std::max(off, std::abs(std::atan2(from_hand.x(), -from_hand.y()) - exact));
        }
        EXPECT_LT(off, 0.05 * std::abs(angle));
    }
}

/// A circle, or to and fro in any direction.
std::function<Vector(double)> drawn_way(Random& random) {
    const double far = random.number(0.05, 0.2);
    const double rate = 2 * std::numbers::pi * random.number(0.5, 2);
    const Vector along = random.direction();
    if (random.below(2) == 0)
        return [=](double time) -> Vector {
            return far * Vector(std::cos(rate * time) - 1, 0, std::sin(rate * time));
        };
    return [=](double time) -> Vector { return far * std::sin(rate * time) * along; };
}

/// As 40 times as fine steps have it, for as long as these agree with still finer ones: two rods,
/// on joints that lock in no pose. More of them, and others, hold together for longer.
TEST_P(LedTrees, FollowAHandThatShakes) {
    Random random(GetParam() == Precision::single ? 57 : 58);
    for (int draw = 0; draw < 12; ++draw) {
        const std::function<Vector(double)> way = drawn_way(random);
        Scene s = led_hand(GetParam(), way, 4, 0.005);
        draw_steps(s.settings, draw, random);
        Rods rods = drawn_rods(random);
        s.settings.leapfrog_start = true;  // else coarse steps are ahead by half of one
        const bool compares = draw < 9;
        if (compares) rods.count = 2, rods.kind = kKinds[draw % 2];
        const Vector velocity = (way(1e-6) - way(0)) / 1e-6;
        hang(s, rods, Vector::Zero(), velocity);
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << rods.count << " rods, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        Scene fine = s;
        fine.settings.dt /= 40;
        Simulation simulation(s, colliders(), "reference"), exact(fine, colliders(), "reference");
        double off = 0;
        while (compares && simulation.time() < 0.5) {
            simulation.step();
            for (int i = 0; i < 40; ++i) exact.step();
            off = std::max(off, (simulation.world().bodies.position[rods.count] -
                                 exact.world().bodies.position[rods.count])
                                    .norm());
        }
        EXPECT_LT(off, 0.02 * rods.count * rods.length);
        std::uint32_t open = 0;
        while (simulation.time() < 4) open += simulation.step().unsolved_trees;
        EXPECT_EQ(open, 0u);
    }
}

/// A hand that rests sets off at once: what hangs by it swings as by one that goes on resting,
/// until it does.
TEST_P(LedTrees, FeelNoJumpBeforeItComes) {
    Random random(GetParam() == Precision::single ? 31 : 32);
    for (const double speed : {0.5, 5.0, 50.0}) {
        const Rods rods = drawn_rods(random);
        const auto loads_after = [&](double at_speed, int steps) {
            const auto way = [&](double time) -> Vector {
                return {at_speed * std::max(0.0, time - 0.5), 2, 0};
            };
            Scene s = led_hand(GetParam(), way, 1, 0.5);
            hang(s, rods, way(0), Vector::Zero());
            Simulation simulation(s, colliders(), "reference");
            for (int i = 0; i < steps; ++i) simulation.step();
            return Vector(simulation.world().bodies.velocity.back());
        };
        SCOPED_TRACE(testing::Message() << speed << " m/s");
        EXPECT_EQ(loads_after(speed, 50), loads_after(0, 50));
        EXPECT_GT((loads_after(speed, 60) - loads_after(0, 60)).norm(), 0.1 * speed);
    }
}

/// Several trees on one hand see it where it is, whoever advances them; and the hand is where its
/// script has it.
TEST_P(LedTrees, GoOnBitForBitInParts) {
    Random random(59);
    for (int draw = 0; draw < 3; ++draw) {
        const std::function<Vector(double)> way = drawn_way(random);
        Scene s = led_hand(GetParam(), way, 3, 0.01);
        draw_steps(s.settings, draw, random);
        for (int tree = 0; tree < 4; ++tree)
            hang(s, drawn_rods(random), {0.1 * tree, 0, 0}, Vector::Zero());
        SCOPED_TRACE(draw);
        const Simulation one = goes_on_bit_for_bit(s, 0.4, 0.4);
        const Bodies& b = one.world().bodies;
        EXPECT_LT((b.position[0] - placement_at(b.script[0], one.time()).position).norm(), 1e-12);
    }
}

}  // namespace
}  // namespace plumb::test
