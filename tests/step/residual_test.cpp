// SPDX-License-Identifier: MIT
/// How far a step says that it is from its constraints, against formulas.
#include "kernels/contact_kernels.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/structures.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace plumb::test {
namespace {

/// Solved by iterations alone, from nothing in each step.
void sweep_from_nothing(Settings& s, std::uint32_t velocity, std::uint32_t position) {
    s.exact_islands = 0;
    s.warm_start = false;
    s.velocity_iterations = velocity, s.position_iterations = position;
}

Scene residual_scene(const Structure& blocks) {
    Scene s;
    s.settings.precision = Precision::double_;
    add_ground(s);
    for (const Block& b : blocks) add_body(s, box(b.half.x(), b.half.y(), b.half.z()), b.centre);
    return s;
}

using Residual = OnEveryCollider;

TEST_P(Residual, OfABoxAtRestIsRounding) {
    for (const std::uint32_t exact : {0u, 400u}) {
        Scene s = scene();
        s.settings.exact_islands = exact;
        s.settings.anchor_stiffness = 0;  // or what pulls it back alternates with the sweeps
        add_ground(s);
        add_body(s, box(0.3, 0.2, 0.4), {0, 0.2, 0}).mass = 2;
        Simulation simulation(s, colliders(), collider());
        StepReport report;
        for (int i = 0; i < 300; ++i) report = simulation.step();

        const bool rounds = s.settings.precision == Precision::single && exact == 0;
        EXPECT_EQ(report.residual.islands, 1u);
        EXPECT_EQ(report.residual.worst.first_body, 1u);
        EXPECT_EQ(report.residual.worst.bodies, 1u);
        EXPECT_EQ(report.residual.worst.exact, exact > 0);
        EXPECT_NEAR(report.residual.worst.weight, 2 * kGravity, 1e-12);
        EXPECT_LT(report.residual.worst.force_of_weight(), rounds ? 1e-5 : 1e-8) << exact;
        EXPECT_LT(report.residual.error, rounds ? 1e-8 : 1e-11) << exact;
    }
}

/// A ball of mass m on one of mass M on the ground, from nothing, at one iteration: whatever of
/// the two contacts is solved first, the other one still lacks what stops the balls against each
/// other, m M / (m + M) g h.
TEST_P(Residual, OfTwoBallsAfterOneIteration) {
    for (const double mass : {0.5, 1.0, 30.0}) {
        Scene s = scene();
        sweep_from_nothing(s.settings, 0, 1);
        s.materials[0].friction = 0;
        add_ground(s);
        add_body(s, sphere(0.5), {0, 0.5, 0}).mass = 2;
        add_body(s, sphere(0.5), {0, 1.5, 0}).mass = mass;
        Simulation simulation(s, colliders(), collider());
        const StepReport report = simulation.step();

        const double h = s.settings.dt, both = 2 * mass / (2 + mass);
        const double force = both * kGravity, weight = (2 + mass) * kGravity;
        const double within = s.settings.precision == Precision::single ? 1e-5 : 1e-6;
        const IslandResidual& worst = report.residual.worst;
        EXPECT_EQ(worst.first_body, 1u);
        EXPECT_EQ(worst.bodies, 2u);
        EXPECT_FALSE(worst.exact);
        EXPECT_NEAR(worst.weight, weight, 1e-12 * weight);
        EXPECT_NEAR(worst.force, force, within * force);
        EXPECT_NEAR(worst.rms_force, force * std::sqrt(0.5), within * force);
        EXPECT_NEAR(worst.force_of_weight(), force / weight, within);
        EXPECT_EQ(report.residual.force, worst.force);
        // the velocity by which that contact approaches: of the upper ball alone, or of the lower
        const double upper = kGravity * h * h, lower = force / 2 * h * h;
        EXPECT_LT(std::min(std::abs(worst.error - upper), std::abs(worst.error - lower)),
                  within * upper);
    }
}

/// The same of two bodies that hang below each other by joints: the upper joint, which comes first,
/// lacks what the lower one took from it.
TEST_P(Residual, OfTwoJointsAfterOneIteration) {
    for (const JointKind kind : {JointKind::ball, JointKind::hinge, JointKind::fixed})
        for (const double mass : {0.5, 30.0}) {
            Scene s = scene();
            sweep_from_nothing(s.settings, 0, 1);
            s.settings.joints = JointMethod::iterate;
            add_body(s, sphere(0.2), {0, -0.5, 0}).mass = 2;
            add_body(s, sphere(0.2), {0, -1.5, 0}).mass = mass;
            for (const std::uint32_t body : {0u, 1u}) {
                JointSpec joint;
                joint.kind = kind;
                joint.body_a = body, joint.body_b = body == 0 ? kNoIndex : 0;
                joint.anchor = {0, -1.0 * body, 0};
                s.joints.push_back(joint);
            }
            Simulation simulation(s, colliders(), collider());
            const IslandResidual worst = simulation.step().residual.worst;

            const double h = s.settings.dt, force = 2 * mass / (2 + mass) * kGravity;
            const double within = s.settings.precision == Precision::single ? 1e-5 : 1e-9;
            EXPECT_EQ(worst.first_body, 0u);
            EXPECT_EQ(worst.bodies, 2u);
            EXPECT_NEAR(worst.force, force, within * force);
            EXPECT_NEAR(worst.rms_force, force * std::sqrt(0.5), within * force);
            EXPECT_NEAR(worst.error, force / 2 * h * h, within * force / 2 * h * h);
        }
}

/// A ball that hangs at a height by a joint, which alone is exact, overlaps the ground: the
/// contact, which has the last word, pushes a share of that out, and opens the joint by as much.
TEST_P(Residual, OfAJointThatIsExactUntilItTouches) {
    constexpr double kOverlap = 1e-3, kMass = 2;
    Scene s = scene();
    sweep_from_nothing(s.settings, 0, 1);
    add_ground(s);
    add_body(s, sphere(0.5), {0, 0.5 - kOverlap, 0}).mass = kMass;
    JointSpec joint;
    joint.body_a = 1, joint.anchor = {0, 0.5 - kOverlap, 0};
    s.joints.push_back(joint);
    Simulation simulation(s, colliders(), collider());
    const IslandResidual worst = simulation.step().residual.worst;

    const double h = s.settings.dt, error = s.settings.stiffness * kOverlap;
    const double force = kMass * error / (h * h);
    EXPECT_FALSE(worst.exact);
    EXPECT_NEAR(worst.error, error, 1e-5 * error);
    EXPECT_NEAR(worst.force, force, 1e-5 * force);
    EXPECT_NEAR(joint_errors(simulation.world())[0], error, 1e-5 * error);
}

/// Without gravity an island is weighed by what its contacts bear.
TEST_P(Residual, IsWeighedByForcesWhereThereIsNoGravity) {
    Scene s = scene();
    s.settings.gravity.setZero();
    sweep_from_nothing(s.settings, 0, 1);
    s.materials[0].friction = 0;
    add_ground(s);
    for (const double y : {0.5, 1.5}) {
        BodySpec& ball = add_body(s, sphere(0.5), {0, y, 0});
        ball.mass = 1, ball.force = {0, -10, 0};
    }
    Simulation simulation(s, colliders(), collider());
    const IslandResidual worst = simulation.step().residual.worst;
    EXPECT_NEAR(worst.force, 5, 1e-4);
    const bool ground_first = std::abs(worst.weight - 15) < 1e-4;
    EXPECT_TRUE(ground_first || std::abs(worst.weight - 10) < 1e-4) << worst.weight;
}

INSTANTIATE_TEST_SUITE_P(All, Residual, every_collider(), where_name);

// ---- against the law of each contact, from what a step leaves

/// What one more solution of a contact alone would change [N s].
struct Lacking {
    double impulse, error;
};

struct Before {
    Bodies bodies;
    double h, stiffness;
};

Eigen::Matrix3d response_of(const Bodies& b, std::uint32_t i, const Vector& point) {
    if (b.motion[i] != Motion::dynamic) return Eigen::Matrix3d::Zero();
    const Eigen::Matrix3d r = b.orientation[i].toRotationMatrix();
    const Eigen::Matrix3d inverse = r * b.inverse_inertia[i].asDiagonal() * r.transpose();
    const Vector arm = point - b.position[i];
    Eigen::Matrix3d cross;
    cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    return b.inverse_mass[i] * Eigen::Matrix3d::Identity() - cross * inverse * cross;
}

Vector velocity_of_point(const World& after, const Bodies& before, std::uint32_t i,
                         const Vector& point) {
    const Bodies& b = after.bodies;
    return b.velocity[i] + b.angular_velocity[i].cross(point - before.position[i]);
}

Lacking lacking_of(const World& after, const Before& at, std::size_t contact) {
    const Contact& c = after.contacts.found[contact];
    const ContactMemory& bears = after.contacts.memory[contact];
    const Vector n = to_eigen(c.normal), point = common_point(c);
    const Vector x = n.unitOrthogonal(), y = n.cross(x);
    const Eigen::Matrix3d k =
        response_of(at.bodies, c.a, point) + response_of(at.bodies, c.b, point);
    // the mean over the step, where bodies turn
    const Vector u = velocity_of_point(after, at.bodies, c.a, point) -
                     velocity_of_point(after, at.bodies, c.b, point) + after.contacts.bend[contact];

    // the gap at the end shall be what is left of the overlap at the start
    const double wanted = -(c.gap - (1 - at.stiffness) * std::min(c.gap, 0.0)) / at.h;
    const double mass = 1 / n.dot(k * n), push = bears.normal_impulse;
    const double normal = std::max(-push, mass * (wanted - n.dot(u)));

    // friction stops the slip within its cone, or opposes it on the cone
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << x, y;
    const Eigen::Matrix2d across = tangents.transpose() * k * tangents;
    const Eigen::Vector2d slip = tangents.transpose() * u,
                          f = tangents.transpose() * bears.friction_impulse;
    const double bound = after.surface_pair(c.a, c.b).friction * push;
    const double greatest =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(across).eigenvalues().maxCoeff();
    Eigen::Vector2d asked = f - across.inverse() * slip;
    double slip_error = slip.norm();
    if (asked.norm() > bound) {
        asked = f - slip / greatest;
        if (asked.norm() > bound) asked *= bound / asked.norm();
        slip_error = std::min(slip_error, greatest * (asked - f).norm());
    }
    return {std::hypot(normal, (asked - f).norm()), std::max(std::abs(normal) / mass, slip_error)};
}

/// Cubes that fall on each other askew, slide and topple: all kinds of errors.
TEST(ResidualOfHeap, IsThatOfItsContactsOneByOne) {
    Scene s = residual_scene({});
    sweep_from_nothing(s.settings, 2, 2);
    s.settings.reuse_distance = s.settings.anchor_stiffness = 0;
    s.settings.recovery_speed = 1e9;
    s.settings.forbid = {"impacts", "still_ground"};
    Random random(3);
    for (int i = 0; i < 8; ++i)
        add_body(s, box(0.2, 0.2, 0.2), {random.number(-0.1, 0.1), 0.25 + 0.45 * i, 0});
    Simulation simulation(s, colliders(), "reference");
    int compared = 0;
    for (int step = 0; step < 60; ++step) {
        const Before before{simulation.world().bodies, s.settings.dt, s.settings.stiffness};
        const StepResidual residual = simulation.step().residual;
        const World& after = simulation.world();
        double impulse = 0, error = 0;
        for (std::size_t i = 0; i < after.contacts.found.size(); ++i) {
            const Lacking lacking = lacking_of(after, before, i);
            impulse = std::max(impulse, lacking.impulse), error = std::max(error, lacking.error);
        }
        if (after.contacts.found.empty()) continue;
        ++compared;
        EXPECT_NEAR(residual.force * before.h, impulse, 1e-6 * impulse + 1e-12) << step;
        EXPECT_NEAR(residual.error, error * before.h, 1e-6 * error * before.h + 1e-15) << step;
    }
    EXPECT_GT(compared, 40);
}

TEST(ResidualOfTower, FallsWithIterationsAndVanishesWhereItIsSolvedExactly) {
    const double weight = 5 * 0.3 * 0.2 * 0.3 * 8000 * kGravity;
    double before = weight;
    for (const std::uint32_t iterations : {2u, 8u, 32u, 128u, 512u, 2048u}) {
        Scene s = residual_scene(tower(5, {0.3, 0.2, 0.3}));
        sweep_from_nothing(s.settings, 0, iterations);
        Simulation simulation(s, colliders(), "reference");
        const StepResidual residual = simulation.step().residual;
        EXPECT_EQ(residual.worst.bodies, 5u);
        EXPECT_LT(residual.worst.force, before) << iterations;
        before = residual.worst.force;
    }
    EXPECT_LT(before, 1e-6 * weight);
    Simulation exact(residual_scene(tower(5, {0.3, 0.2, 0.3})), colliders(), "reference");
    for (int i = 0; i < 5; ++i) {
        const StepResidual residual = exact.step().residual;
        EXPECT_TRUE(residual.worst.exact);
        EXPECT_LT(residual.worst.force_of_weight(), 1e-8);
    }
}

/// Two towers on the ground are two islands, and a kinematic plank across their tops joins none.
TEST(ResidualOfIslands, TellsThemApart) {
    Structure towers = tower(3, {0.2, 0.2, 0.2});
    for (const Block& b : tower(2, {0.2, 0.3, 0.2}))
        towers.push_back({b.half, b.centre + Vector(1, 0, 0)});
    Scene s = residual_scene(towers);
    add_body(s, box(1, 0.05, 0.2), {0.5, 1.25, 0}).motion = Motion::kinematic;
    sweep_from_nothing(s.settings, 1, 1);
    Simulation simulation(s, colliders(), "reference");
    const StepReport report = simulation.step();
    EXPECT_GT(report.contacts, 16u) << "the plank touches both";
    const std::vector<IslandResidual>& islands = simulation.island_residuals();
    ASSERT_EQ(islands.size(), 2u);
    EXPECT_EQ(report.residual.islands, 2u);
    EXPECT_EQ(islands[0].first_body, 1u);
    EXPECT_EQ(islands[0].bodies, 3u);
    EXPECT_EQ(islands[1].first_body, 4u);
    EXPECT_EQ(islands[1].bodies, 2u);
    const auto worst = std::max_element(islands.begin(), islands.end(),
                                        [](const IslandResidual& a, const IslandResidual& b) {
                                            return a.force_of_weight() < b.force_of_weight();
                                        });
    EXPECT_EQ(worst->first_body, report.residual.worst.first_body);
    EXPECT_EQ(std::max(islands[0].force, islands[1].force), report.residual.force);
}

TEST(ResidualOfHeap, HasTheSameBitsOnAnyThreadsAndLanes) {
    Scene s = residual_scene({});
    s.settings.precision = Precision::single;
    s.settings.exact_islands = 12;
    Random random(5);
    for (int i = 0; i < 120; ++i)
        add_body(s, i % 2 == 0 ? box(0.2, 0.2, 0.2) : sphere(0.2),
                 {0.5 * (i % 6) + random.number(-0.1, 0.1), 0.3 + 0.5 * (i / 24),
                  0.5 * (i / 6 % 4) + random.number(-0.1, 0.1)});
    std::vector<StepResidual> expected;
    for (const auto& [threads, lanes] : {std::pair(1u, 1u), std::pair(3u, 1u), std::pair(1u, 4u),
                                         std::pair(2u, 8u), std::pair(2u, 16u)}) {
        if (static_cast<int>(lanes) > widest_lanes()) continue;
        s.settings.threads = threads, s.settings.lanes = lanes;
        Simulation simulation(s, colliders(), "reference");
        for (std::size_t i = 0; i < 100; ++i) {
            const StepResidual r = simulation.step().residual;
            if (threads == 1 && lanes == 1) {
                expected.push_back(r);
                continue;
            }
            ASSERT_EQ(r.islands, expected[i].islands);
            ASSERT_EQ(r.force, expected[i].force) << threads << " " << lanes << " " << i;
            ASSERT_EQ(r.error, expected[i].error);
            ASSERT_EQ(r.worst.first_body, expected[i].worst.first_body);
            ASSERT_EQ(r.worst.bodies, expected[i].worst.bodies);
            ASSERT_EQ(r.worst.exact, expected[i].worst.exact);
            ASSERT_EQ(r.worst.force, expected[i].worst.force);
            ASSERT_EQ(r.worst.rms_force, expected[i].worst.rms_force);
            ASSERT_EQ(r.worst.weight, expected[i].worst.weight);
        }
    }
    EXPECT_GT(expected.back().islands, 0u);
}

}  // namespace
}  // namespace plumb::test
