// SPDX-License-Identifier: MIT
/// What no constraint may change: linear and angular momentum of bodies that only touch each other,
/// or are joined to each other.
/// Steps: 0.01 s with 5 + 5 iterations, 1/60 s with 20 substeps of 1 + 1, and others at random.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"

#include <iostream>

namespace plumb::test {
namespace {

class Momentum : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Momentum, every_collider(), where_name);

TEST_P(Momentum, SurvivesACollision) {
    Scene s = scene();
    s.settings.gravity.setZero();
    s.materials[0].restitution = 0.5;
    BodySpec& a = add_body(s, box(0.5, 0.4, 0.3), {-1, 0.2, 0.1});
    a.velocity = {2, 0, 0};
    a.angular_velocity = {1, 2, 0.5};
    add_body(s, box(0.3, 0.5, 0.6), {1, 0, 0}).velocity = {-1, 0.1, 0};
    Simulation simulation(s, colliders(), collider());
    const Vector p0 = linear_momentum(simulation.world()),
                 l0 = angular_momentum(simulation.world());
    const double e0 = kinetic_energy(simulation.world());
    run_for(simulation, 2);
    EXPECT_LT(kinetic_energy(simulation.world()), 0.98 * e0) << "they must have met";
    const double bound = s.settings.precision == Precision::single ? 1e-5 : 1e-10;
    EXPECT_LT((linear_momentum(simulation.world()) - p0).norm(), bound * 1000);
    EXPECT_LT((angular_momentum(simulation.world()) - l0).norm() / l0.norm(), bound);
}

/// Balls, boxes and capsules on a grid, of 1 to 10^heaviest kg, drawn together and spun; they meet,
/// slide, roll and bounce.
struct FreeHeap {
    Scene scene;

    FreeHeap(const Scene& empty, int side, double spin, double heaviest, Random& random)
        : scene(empty) {
        scene.settings.gravity.setZero();
        scene.materials[0].restitution = 0.3;
        scene.materials[0].rolling_friction = 0.01;
        scene.materials[0].spinning_friction = 0.005;
        const Vector middle = Vector::Constant(0.225 * (side - 1));
        for (int i = 0; i < side * side * side; ++i) {
            const Vector at = 0.45 * Vector(i % side, i / side % side, i / side / side);
            BodySpec& b = add_body(scene, shape(i % 3), at - middle);
            b.placement.rotation = random.rotation();
            b.velocity = Vector(0.3, 0.2, -0.1) - 1.5 * (at - middle) + random.vector(0.5);
            b.angular_velocity = random.vector(spin);
            b.mass = std::pow(10.0, random.number(0, heaviest));
        }
    }
    static Geometry shape(int kind) {
        if (kind == 0) return sphere(0.2);
        if (kind == 1) return box(0.1, 0.12, 0.16);
        return capsule(0.1, 0.1);
    }
};

/// Momentum about the common centre of mass, and the sums of its bodies' magnitudes.
struct Momenta {
    Vector linear = Vector::Zero(), angular = Vector::Zero();
    double linear_sum = 0, angular_sum = 0;

    explicit Momenta(const World& w) {
        const Bodies& b = w.bodies;
        Vector centre = Vector::Zero();
        double mass = 0;
        for (std::size_t i = 0; i < b.size(); ++i) {
            mass += b.mass[i];
            centre += b.mass[i] * b.position[i];
            linear += b.mass[i] * b.velocity[i];
            linear_sum += b.mass[i] * b.velocity[i].norm();
        }
        centre /= mass;
        for (std::size_t i = 0; i < b.size(); ++i) {
            const Rotation& q = b.orientation[i];
            const Vector spin =
                q * b.inertia[i].cwiseProduct(q.conjugate() * b.angular_velocity[i]);
            const Vector l =
                (b.position[i] - centre).cross(b.mass[i] * (b.velocity[i] - linear / mass)) + spin;
            angular += l;
            angular_sum += l.norm();
        }
    }
};

std::string words_of(const Settings& s) {
    return std::to_string(s.dt) + " s x " + std::to_string(s.substeps) + " x (" +
           std::to_string(s.velocity_iterations) + " + " + std::to_string(s.position_iterations) +
           ")" + (s.exact_islands ? "" : ", iterated");
}

/// Expects the momentum back that there was. Spin becomes speed, and the other way round.
void expect_sums_kept(const World& world, const Momenta& before, const std::string& where) {
    const Momenta after(world);
    const double linear = (after.linear - before.linear).norm() /
                          std::max(before.linear_sum, after.linear_sum),
                 angular = (after.angular - before.angular).norm() /
                           std::max(before.angular_sum, after.angular_sum);
    std::cout << where << ": linear " << linear << ", angular " << angular << "\n";
    const double bound = world.settings.precision == Precision::single ? 1e-6 : 1e-10;
    EXPECT_LT(linear, bound) << where;
    EXPECT_LT(angular, bound) << where;
}

/// Runs a free heap and expects its momentum back.
void expect_momentum_kept(const Scene& empty, const std::string& collider, int side, double seconds,
                          double spin, unsigned seed) {
    Random random(seed);
    const std::string where = words_of(empty.settings) + ", spin " + std::to_string(spin);
    Simulation simulation(FreeHeap(empty, side, spin, seed % 2 == 0 ? 1 : 3, random).scene,
                          colliders(), collider);
    const Momenta before(simulation.world());
    const double energy = kinetic_energy(simulation.world());
    run_for(simulation, seconds);
    expect_sums_kept(simulation.world(), before, where);
    EXPECT_LT(kinetic_energy(simulation.world()), 0.95 * energy) << "they must have met";
}

TEST_P(Momentum, OfAFreeHeapIsKept) {
    for (const bool iterated : {false, true}) {
        Scene s = scene();
        if (iterated) s.settings.exact_islands = 0;
        expect_momentum_kept(s, collider(), 3, 1, 5, 1);
        use_fine_steps(s.settings);
        expect_momentum_kept(s, collider(), 3, 1, 5, 2);
    }
}

TEST_P(Momentum, OfAFreeHeapIsKeptAtAnySettings) {
    Random random(11);
    for (int i = 0; i < 12; ++i) {
        Scene s = scene();
        s.settings.dt = random.number(0.001, 0.02);
        s.settings.substeps = 1 + random.below(40);
        s.settings.velocity_iterations = 1 + random.below(i % 2 == 0 ? 3 : 50);
        s.settings.position_iterations = 1 + random.below(i % 2 == 0 ? 3 : 50);
        s.settings.exact_islands = i % 3 == 0 ? 0 : 400;
        const double spin = std::pow(10.0, random.number(0, 2.5));
        expect_momentum_kept(s, collider(), 2, 0.4, spin, 100u + static_cast<unsigned>(i));
    }
}

/// A ball or a box that flies along y, from so far away [m], to where something is along x.
void add_projectile(Scene& scene, Random& random, double along, double away) {
    const double size = random.number(0.04, 0.15);
    const Vector at(random.number(0, along), -away, random.number(-0.05, 0.05));
    BodySpec& b = random.below(2) == 0 ? add_body(scene, sphere(size), at)
                                       : add_body(scene, box({size, size, size}), at);
    b.mass = random.number(0.2, 2);
    b.velocity = {0, random.number(2, 8), 0};
    b.angular_velocity = random.vector(2);
}

/// In free space, of any restitution and friction.
Scene free_space(const Settings& settings, Random& random) {
    Scene scene;
    scene.settings = settings;
    scene.settings.gravity.setZero();
    scene.materials[0].restitution = random.number(0, 1);
    scene.materials[0].friction = random.number(0, 1);
    return scene;
}

/// Links in a row along x, with others that stick out of them, spun as one about their middle, and
/// balls and boxes that fly into them.
struct HitTree {
    Scene scene;

    HitTree(const Settings& settings, Random& random) : scene(free_space(settings, random)) {
        const std::uint32_t links = 3 + random.below(10);
        while (scene.bodies.size() < links) add_link(random);
        const Vector spin = random.vector(2);
        for (BodySpec& link : scene.bodies) {
            link.angular_velocity = spin;
            link.velocity = spin.cross(link.placement.position - end_ / 2);
        }
        add_projectile(scene, random, end_.x(), 0.6);
        if (random.below(2) == 0) add_projectile(scene, random, end_.x(), 1);
    }

private:
    /// On at the end of the row, or out of the middle of its last link.
    void add_link(Random& random) {
        const auto body = static_cast<std::uint32_t>(scene.bodies.size());
        const bool aside = body == row_ + 1 && random.below(3) == 0;
        const double length = random.number(0.1, 0.4), radius = random.number(0.05, 0.12) * length;
        const Vector way =
            aside ? Vector(0, 0, 1)
                  : Vector(1, random.number(-0.4, 0.4), random.number(-0.2, 0.2)).normalized();
        const Vector start = aside ? scene.bodies[row_].placement.position : end_;
        const Vector half = length / 2 * way;
        const Geometry shape = random.below(2) == 0 ? capsule(radius, length / 2 - radius)
                                                    : box({radius, length / 2, radius});
        BodySpec& link = add_body(scene, shape, start + half);
        link.placement.rotation = Rotation::FromTwoVectors(Vector::UnitY(), way);
        link.mass = random.number(0.1, 1);
        if (body > 0) join(random, body, start);
        if (aside) return;
        end_ += 2 * half, row_ = body;
    }

    void join(Random& random, std::uint32_t body, const Vector& at) {
        constexpr JointKind kKinds[] = {JointKind::ball, JointKind::hinge, JointKind::universal,
                                        JointKind::slider};
        add_joint(scene, kKinds[random.below(4)], body, row_, at).frame = random.rotation();
    }

    Vector end_ = Vector::Zero();  // of the row
    std::uint32_t row_ = 0;        // its last link
};

/// Rods in a ring that is no tree, into which something flies from the side.
Scene hit_ring(const Settings& settings, Random& random) {
    Scene s = free_space(settings, random);
    const std::uint32_t links = 3 + random.below(5);
    const double length = random.number(0.1, 0.3), step = 2 * std::numbers::pi / links;
    const double radius = length / 2 / std::sin(step / 2);
    const auto corner = [&](std::uint32_t i) -> Vector {
        return radius * Vector(std::cos(i * step), std::sin(i * step), 0);
    };
    for (std::uint32_t i = 0; i < links; ++i) {
        const Vector way = corner(i + 1) - corner(i);
        BodySpec& link = add_body(s, capsule(0.1 * length, 0.4 * length), corner(i) + way / 2);
        link.placement.rotation = Rotation::FromTwoVectors(Vector::UnitY(), way);
        link.velocity = Vector(0, 0, 2).cross(link.placement.position);
        link.angular_velocity = {0, 0, 2};
        add_joint(s, JointKind::ball, i, (i + links - 1) % links, corner(i));
    }
    add_projectile(s, random, 0.5 * radius, 1);
    return s;
}

/// Whether the step tells of joints or islands that it did not solve.
bool tells(const StepReport& report) {
    return report.unsolved_trees + report.unsolved_islands + report.gaping.joints > 0;
}

/// The usual steps, fine ones, and others at random; joints and contacts solved and iterated.
Settings drawn_settings(Settings s, Random& random, int draw) {
    if (draw % 3 == 1) use_fine_steps(s);
    if (draw % 3 == 2) draw_steps(s, random, {0.001, 0.02, 40, 1, 50});
    if (draw % 5 == 4) s.exact_islands = 0;
    if (draw % 10 == 7) s.joints = JointMethod::iterate;
    return s;
}

/// Runs what is hit, and expects its momentum back, and no more energy unless the step tells of
/// what it did not solve. Returns whether anything touched.
bool keeps_momentum(const Scene& scene, const std::string& collider, int draw) {
    const std::string where = words_of(scene.settings) + ", draw " + std::to_string(draw);
    Simulation simulation(scene, colliders(), collider);
    const Momenta before(simulation.world());
    const double energy = kinetic_energy(simulation.world());
    double most = energy;
    bool told = false, touched = false;
    while (simulation.time() < 0.6) {
        const StepReport report = simulation.step();
        told |= tells(report), touched |= report.contacts > 0;
        most = std::max(most, kinetic_energy(simulation.world()));
    }
    expect_sums_kept(simulation.world(), before, where);
    EXPECT_TRUE(told || most < 1.001 * energy) << where << ", " << most / energy;
    return touched;
}

TEST_P(Momentum, OfAFreeTreeThatIsHitIsKept) {
    Random random(31);
    int met = 0;
    for (int draw = 0; draw < 30; ++draw) {
        const Settings settings = drawn_settings(scene().settings, random, draw);
        met += keeps_momentum(HitTree(settings, random).scene, collider(), draw);
    }
    EXPECT_GT(met, 20);
}

TEST_P(Momentum, OfAFreeRingThatIsHitIsKept) {
    Random random(32);
    int met = 0;
    for (int draw = 0; draw < 15; ++draw) {
        const Settings settings = drawn_settings(scene().settings, random, draw);
        met += keeps_momentum(hit_ring(settings, random), collider(), draw);
    }
    EXPECT_GT(met, 10);
}

TEST_P(Momentum, SurvivesABallJoint) {
    Scene s = scene();
    use_fine_steps(s.settings);
    s.settings.gravity.setZero();
    add_body(s, box(0.5, 0.1, 0.1), {0, 0, 0}).angular_velocity = {0, 2, 1};
    add_body(s, box(0.5, 0.1, 0.1), {1, 0, 0}).velocity = {0, 0.5, 0};
    JointSpec joint;
    joint.body_a = 0, joint.body_b = 1;
    joint.anchor = {0.5, 0, 0};
    s.joints.push_back(joint);
    Simulation simulation(s, colliders(), collider());
    const Vector p0 = linear_momentum(simulation.world());
    run_for(simulation, 2);
    const double bound = s.settings.precision == Precision::single ? 1e-5 : 1e-10;
    EXPECT_LT((linear_momentum(simulation.world()) - p0).norm() / p0.norm(), bound);
    EXPECT_LT(joint_errors(simulation.world())[0], 1e-4);
}

}  // namespace
}  // namespace plumb::test
