// SPDX-License-Identifier: MIT
/// What contacts bear in a step, against what Newton's laws say of it; and when pairs begin to
/// touch, hit and end.
#include "host/editing.h"

#include <map>

namespace plumb::test {
namespace {

/// Sum of the impulses on a body, of all its contacts [N s].
Vector impulse_on(const Simulation& simulation, std::uint32_t body) {
    Vector sum = Vector::Zero();
    for (const BodyContact& c : simulation.contacts()) {
        if (c.body_a == body) sum += c.impulse();
        if (c.body_b == body) sum -= c.impulse();
    }
    return sum;
}

/// A box of 2 kg at rest on the ground; exact: solved as an island, else by iterations.
Scene box_at_rest(std::uint32_t substeps, bool exact, Precision precision) {
    Scene s;
    s.settings.substeps = substeps, s.settings.precision = precision;
    if (!exact) s.settings.exact_islands = 0;
    add_ground(s);
    add_body(s, box(0.3, 0.2, 0.4), {0, 0.2, 0}).mass = 2;
    return s;
}

/// What moves by itself does so where nothing can touch, or touching is forbidden.
TEST(Contacts, AreNotNeededForWhatMovesByItself) {
    for (const std::uint32_t substeps : {1u, 4u})
        for (const bool forbidden : {false, true})
            for (const std::uint32_t threads : {1u, 3u}) {
                Scene s;
                s.settings.substeps = substeps, s.settings.threads = threads;
                if (forbidden) s.settings.forbid = {"contacts"};
                BodySpec& plate = add_body(s, box(1, 0.1, 1), {0, 0, 0}, Motion::kinematic);
                plate.velocity = {0.5, 0, 0};
                BodySpec& falls = add_body(s, box(0.1, 0.1, 0.1), {0, 0.15, 0});
                if (!forbidden) s.bodies[0].mask = falls.mask = 0;
                Simulation simulation(s, colliders(), "reference");
                for (int i = 0; i < 50; ++i) simulation.step();
                EXPECT_NEAR(simulation.world().bodies.position[0].x(), 0.25, 1e-9);
                EXPECT_NEAR(simulation.world().bodies.velocity[1].y(), -kGravity * 0.5, 1e-9);
            }
}

class ContactWeights : public testing::TestWithParam<std::tuple<std::uint32_t, bool>> {};

TEST_P(ContactWeights, ABoxAtRestBearsItsWeight) {
    const auto [substeps, exact] = GetParam();
    Simulation simulation(box_at_rest(substeps, exact, Precision::double_), colliders(),
                          "reference");
    simulation.watch_contacts();
    for (int i = 0; i < 200; ++i) simulation.step();
    double force = 0;
    ASSERT_EQ(simulation.contacts().size(), 4u);
    for (const BodyContact& c : simulation.contacts()) {
        EXPECT_EQ(c.body_a, 0u);
        EXPECT_EQ(c.body_b, 1u);
        EXPECT_NEAR(c.normal.y(), -1, 1e-12) << "out of b towards a, and the ground is a";
        EXPECT_GE(c.normal_force, 0) << "how four corners share it is nobody's law";
        EXPECT_NEAR(c.gap, 0, 1e-5);
        EXPECT_NEAR(std::abs(c.point_b.x()), 0.3, 1e-6);
        EXPECT_NEAR(c.point_a.y(), 0, 1e-9);
        force += c.normal_force;
    }
    EXPECT_NEAR(force, 2 * kGravity, 1e-6 * 2 * kGravity);
    EXPECT_NEAR(impulse_on(simulation, 1).y(), 2 * kGravity * 0.01, 1e-6 * 2 * kGravity * 0.01);
}

INSTANTIATE_TEST_SUITE_P(All, ContactWeights,
                         testing::Combine(testing::Values(1u, 10u), testing::Bool()),
                         [](const auto& param_info) {
                             return std::to_string(std::get<0>(param_info.param)) + "substeps_" +
                                    (std::get<1>(param_info.param) ? "exact" : "iterated");
                         });

/// In each step m Δv = m g dt + Σ impulses, whatever solved the contacts.
void expect_balance(Simulation& simulation, std::uint32_t body, int steps, double tolerance) {
    simulation.watch_contacts();
    const World& world = simulation.world();
    const double mass = world.bodies.mass[body];
    for (int i = 0; i < steps; ++i) {
        const Vector before = simulation.body_state(body).velocity;
        simulation.step();
        const Vector change = simulation.body_state(body).velocity - before;
        const Vector expected = mass * (change - world.settings.dt * world.settings.gravity);
        ASSERT_LT((impulse_on(simulation, body) - expected).norm(), tolerance) << "step " << i;
    }
}

class FlyingBall : public testing::TestWithParam<std::tuple<std::uint32_t, double>> {};

/// At 30 m/s, with 10 substeps, the impulse of the last of them alone would be nothing.
TEST_P(FlyingBall, IsStoppedByTheImpulseThatItReads) {
    const auto [substeps, restitution] = GetParam();
    Scene s;
    s.settings.substeps = substeps, s.settings.precision = Precision::double_;
    s.materials[0].restitution = restitution;
    add_ground(s);
    add_body(s, sphere(0.1), {0, 1, 0}).velocity = {3, -30, 0};
    Simulation simulation(s, colliders(), "reference");
    simulation.watch_contacts({.least_speed = 10});
    const double mass = simulation.world().bodies.mass[1];
    int hits = 0;
    double knock = 0, fastest = 0;
    for (int i = 0; i < 12; ++i) {
        const Vector before = simulation.body_state(1).velocity;
        simulation.step();
        const Vector change = simulation.body_state(1).velocity - before;
        const Vector expected = mass * (change + Vector(0, kGravity * 0.01, 0));
        ASSERT_LT((impulse_on(simulation, 1) - expected).norm(), 1e-6 * mass * 30) << "step " << i;
        for (const ContactEvent& event : simulation.contact_events()) {
            if (event.kind != ContactEvent::Kind::hit) continue;
            ++hits;
            knock += event.impulse;
            fastest = std::max(fastest, event.approach_speed);
            EXPECT_NEAR(event.point.x(), 3 * 0.03, 0.05);
        }
    }
    // what does not bounce is braked to the surface in one step, and stopped in the next
    EXPECT_EQ(hits, restitution == 0 ? 2 : 1);
    EXPECT_NEAR(fastest, 30, 0.5);
    EXPECT_NEAR(knock, mass * (1 + restitution) * 30.3, 0.01 * mass * (1 + restitution) * 30);
}

INSTANTIATE_TEST_SUITE_P(All, FlyingBall,
                         testing::Combine(testing::Values(1u, 10u), testing::Values(0.0, 0.5, 1.0)),
                         [](const auto& param_info) {
                             return std::to_string(std::get<0>(param_info.param)) + "substeps_e" +
                                    std::to_string(int(10 * std::get<1>(param_info.param)));
                         });

TEST(ContactSums, BalanceMomentumWhateverSolves) {
    for (const char* required : {"", "shock_propagation"})
        for (const std::uint32_t islands : {0u, 400u})
            for (const bool warm : {true, false}) {
                Scene s = heap();
                s.settings.substeps = 3, s.settings.precision = Precision::double_;
                s.settings.exact_islands = islands, s.settings.warm_start = warm;
                s.settings.forbid = {"still_ground"};  // it takes energy back without a force
                if (*required) s.settings.require = {required};
                s.materials[0].restitution = 0.3;
                add_body(s, sphere(0.3), {1.4, 6, 0.4}).velocity = {0, -20, 0};
                Simulation simulation(s, colliders(), "reference");
                const auto ball = static_cast<std::uint32_t>(s.bodies.size()) - 1;
                SCOPED_TRACE(std::string(required) + std::to_string(islands) + (warm ? "w" : ""));
                // what shock propagation adds does not act below: there the ball must be on top
                expect_balance(simulation, ball, *required ? 30 : 60,
                               1e-6 * 20 * simulation.world().bodies.mass[ball]);
            }
}

TEST(ContactSums, FrictionHoldsABoxOnASlopeAndBrakesOneThatSlides) {
    for (const double friction : {0.8, 0.2})
        for (const std::uint32_t substeps : {1u, 10u}) {
            Scene s;
            const double slope = 0.4;  // tan 0.42
            s.settings.gravity =
                Rotation(Eigen::AngleAxisd(slope, Vector::UnitZ())) * Vector(0, -kGravity, 0);
            s.settings.substeps = substeps, s.settings.precision = Precision::double_;
            s.materials[0].friction = friction;
            add_ground(s);
            add_body(s, box(0.4, 0.1, 0.4), {0, 0.1, 0}).mass = 3;
            Simulation simulation(s, colliders(), "reference");
            simulation.watch_contacts();
            for (int i = 0; i < 100; ++i) simulation.step();
            Vector across = Vector::Zero();
            double pressed = 0;
            for (const BodyContact& c : simulation.contacts())
                across -= c.friction_force, pressed += c.normal_force;
            const double weight = 3 * kGravity * std::cos(slope);
            EXPECT_NEAR(pressed, weight, 1e-3 * weight);
            const double held = -3 * kGravity * std::sin(slope), slides = -friction * weight;
            EXPECT_NEAR(across.x(), std::abs(held) < std::abs(slides) ? held : slides,
                        1e-3 * weight);
            EXPECT_NEAR(across.y(), 0, 1e-9 * weight);
        }
}

TEST(ContactSums, MaterialsAndPartsAreThoseOfTheBodies) {
    Scene s;
    s.materials.push_back({"rubber", 900, 0.9, 0, 0, 0});
    add_ground(s);
    add_body(s, sphere(0.2), {0, 0.2, 0}).material = 1;
    Simulation simulation(s, colliders(), "reference");
    simulation.watch_contacts();
    simulation.step();
    ASSERT_EQ(simulation.contacts().size(), 1u);
    EXPECT_EQ(simulation.contacts()[0].material_a, 0u);
    EXPECT_EQ(simulation.contacts()[0].material_b, 1u);
}

/// Bodies are named by identifiers where slots and identifiers have parted, the lower one first.
TEST(ContactSums, AreOfIdentifiers) {
    Scene s = box_at_rest(1, false, Precision::double_);
    add_body(s, sphere(0.1), {5, 9, 0});
    Simulation simulation(s, colliders(), "reference");
    simulation.watch_contacts();
    simulation.remove_body(0);
    BodySpec ground;
    ground.motion = Motion::fixed;
    ground.geometry = 0;
    EXPECT_EQ(simulation.slot_of(simulation.add_body(ground)), 0u);
    for (int i = 0; i < 100; ++i) simulation.step();
    ASSERT_EQ(simulation.contacts().size(), 4u);
    double force = 0;
    for (const BodyContact& c : simulation.contacts()) {
        EXPECT_EQ(c.body_a, 1u);
        EXPECT_EQ(c.body_b, 3u);
        EXPECT_NEAR(c.normal.y(), 1, 1e-12);
        EXPECT_NEAR(c.gap, 0, 1e-5);
        EXPECT_NEAR(c.point_a.y() - c.point_b.y(), c.gap, 1e-12);
        force += c.normal_force;
    }
    EXPECT_NEAR(force, 2 * kGravity, 1e-5 * 2 * kGravity);
}

TEST(ContactSums, ThrowWhereNobodyWatches) {
    Simulation simulation(box_at_rest(1, false, Precision::single), colliders(), "reference");
    EXPECT_THROW(simulation.contacts(), std::logic_error);
    simulation.watch_contacts();
    EXPECT_TRUE(simulation.contacts().empty()) << "before the first step that is watched";
    simulation.step();
    EXPECT_FALSE(simulation.contacts().empty());
    simulation.stop_watching_contacts();
    EXPECT_THROW(simulation.contact_events(), std::logic_error);
}

/// Events of all steps as words: "3: began 0 1".
std::vector<std::string> told(Simulation& simulation, int steps) {
    std::vector<std::string> words;
    for (int i = 1; i <= steps; ++i) {
        simulation.step();
        for (const ContactEvent& e : simulation.contact_events()) {
            const char* kinds[] = {"began", "hit", "ended"};
            words.push_back(std::to_string(i) + ": " + kinds[static_cast<int>(e.kind)] + " " +
                            std::to_string(e.body_a) + " " + std::to_string(e.body_b));
        }
    }
    return words;
}

TEST(ContactEvents, ComeAtTheRightSteps) {
    for (const std::uint32_t substeps : {1u, 10u}) {
        Scene s;
        s.settings.gravity = Vector::Zero(), s.settings.substeps = substeps;
        s.settings.precision = Precision::double_;
        s.materials[0].restitution = 1;
        add_ground(s);
        // 0.1 m above the ground at 4 m/s: there after 2.5 steps
        add_body(s, sphere(0.2), {0, 0.3, 0}).velocity = {0, -4, 0};
        Simulation simulation(s, colliders(), "reference");
        simulation.watch_contacts({.least_impulse = 1});
        const std::vector<std::string> words = told(simulation, 8);
        ASSERT_EQ(words.size(), 3u) << substeps;
        EXPECT_EQ(words[0], "3: began 0 1");
        // a bounce comes in the first substep that begins with the surfaces touching
        EXPECT_EQ(words[1], substeps == 1 ? "4: hit 0 1" : "3: hit 0 1");
        EXPECT_TRUE(words[2] == "4: ended 0 1" || words[2] == "3: ended 0 1") << words[2];
    }
}

TEST(ContactEvents, ATouchLastsUntilTheBodiesPartOrOneGoes) {
    Simulation simulation(box_at_rest(2, true, Precision::single), colliders(), "reference");
    simulation.watch_contacts();
    EXPECT_EQ(told(simulation, 1), std::vector<std::string>{"1: began 0 1"});
    EXPECT_TRUE(told(simulation, 300).empty());
    simulation.set_placement(1, {{0, 3, 0}, Rotation::Identity()});
    EXPECT_EQ(told(simulation, 1), std::vector<std::string>{"1: ended 0 1"});
    simulation.set_placement(1, {{0, 0.2, 0}, Rotation::Identity()});
    simulation.set_velocity(1, Vector::Zero(), Vector::Zero());
    EXPECT_EQ(told(simulation, 1), std::vector<std::string>{"1: began 0 1"});
    simulation.remove_body(1);
    EXPECT_EQ(told(simulation, 2), std::vector<std::string>{"1: ended 0 1"});
}

/// What is read of a heap on any number of threads, and that reading changes no bit.
TEST(ContactEvents, AreTheSameOnAnyNumberOfThreads) {
    Settings settings;
    settings.substeps = 2;
    std::vector<std::string> first;
    std::vector<double> impulses;
    std::uint64_t hash = 0;
    for (const std::uint32_t threads : {1u, 2u, 3u}) {
        settings.threads = threads;
        Scene s = heap(settings);
        s.materials[0].restitution = 0.4;
        Simulation quiet(s, colliders(), "ode"), watched(s, colliders(), "ode");
        watched.watch_contacts({.least_speed = 0.5});
        std::vector<std::string> words;
        std::vector<double> sums;
        for (int i = 0; i < 60; ++i) {
            quiet.step();
            for (const std::string& word : told(watched, 1)) words.push_back(word);
            for (const BodyContact& c : watched.contacts())
                sums.push_back(c.normal_impulse + c.friction_impulse.x());
            ASSERT_EQ(hash_of(watched), hash_of(quiet)) << "step " << i;
        }
        EXPECT_GT(words.size(), 50u);
        if (threads == 1) first = words, impulses = sums, hash = hash_of(quiet);
        EXPECT_EQ(words, first);
        EXPECT_EQ(sums, impulses);
        EXPECT_EQ(hash_of(quiet), hash);
    }
}

/// A sheet at rest on a box: what its particles bear is its weight, and so is what the box feels.
TEST(ParticleContacts, BearTheWeightOfASheet) {
    for (const std::uint32_t substeps : {1u, 5u}) {
        Scene s;
        s.settings.substeps = substeps, s.settings.precision = Precision::double_;
        s.settings.position_iterations = 20;
        add_ground(s);
        DeformableSpec sheet;
        sheet.material = 0;
        sheet.mass = 0.5;
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 5; ++j) sheet.points.push_back({0.1 * i, 0.006, 0.1 * j});
        for (std::uint32_t i = 0; i < 4; ++i)
            for (std::uint32_t j = 0; j < 4; ++j) {
                const std::uint32_t at = 5 * i + j;
                sheet.triangles.push_back({at, at + 1, at + 6});
                sheet.triangles.push_back({at, at + 6, at + 5});
            }
        s.deformables.push_back(sheet);
        Simulation simulation(s, colliders(), "reference");
        simulation.watch_contacts();
        for (int i = 0; i < 300; ++i) simulation.step();
        ASSERT_EQ(simulation.particle_contacts().size(), 25u);
        double force = 0;
        for (const ParticleContact& c : simulation.particle_contacts()) {
            EXPECT_EQ(c.body, 0u);
            EXPECT_EQ(c.deformable, 0u);
            EXPECT_NEAR(c.point_b.y(), 0, 1e-9);
            EXPECT_NEAR(c.gap, 0, 1e-4);
            force += c.normal_force;
        }
        EXPECT_NEAR(force, 0.5 * kGravity, 1e-3 * 0.5 * kGravity) << substeps;
    }
}

}  // namespace
}  // namespace plumb::test
