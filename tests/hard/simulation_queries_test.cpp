// SPDX-License-Identifier: MIT
/// Rays and closest points through the facade, on every plugin, against closed forms; and what is
/// thrown where there is no answer.
#include "scene/error.h"
#include "support/random.h"
#include "support/scenes.h"

#include <cmath>

namespace plumb::test {
namespace {

/// A ball of 0.5 m at rest in the air, 2 m over the ground, and a cube 3 m beside it.
Scene in_the_air() {
    Scene s;
    s.settings.gravity = Vector::Zero();
    add_ground(s);
    add_body(s, sphere(0.5), {0, 2, 0}).group = 2;
    add_body(s, box(0.5, 0.5, 0.5), {3, 2, 0});
    return s;
}

class SimulationQueries : public testing::TestWithParam<std::string> {};

TEST_P(SimulationQueries, CastRays) {
    Simulation simulation(in_the_air(), colliders(), GetParam());
    simulation.step();
    const auto down = simulation.cast_ray({0.3, 10, 0}, -Vector::UnitY());
    ASSERT_TRUE(down);
    EXPECT_EQ(down->body, 1u);
    EXPECT_NEAR(down->distance, 10 - 2.4, 1e-12);
    EXPECT_NEAR(down->normal.x, 0.6, 1e-12);
    EXPECT_NEAR(down->normal.y, 0.8, 1e-12);

    const auto others = simulation.cast_ray({0.3, 10, 0}, -Vector::UnitY(), 20, ~2u);
    ASSERT_TRUE(others);
    EXPECT_EQ(others->body, 0u);
    EXPECT_NEAR(others->distance, 10, 1e-12);
    EXPECT_FALSE(simulation.cast_ray({0.3, 10, 0}, -Vector::UnitY(), 7.5));
    EXPECT_FALSE(simulation.cast_ray({0.3, 10, 0}, Vector::UnitY()));
}

TEST_P(SimulationQueries, FindClosestPoints) {
    Simulation simulation(in_the_air(), colliders(), GetParam());
    simulation.step();
    const Contact c = simulation.closest(2, 1);
    EXPECT_EQ(c.a, 1u);
    EXPECT_EQ(c.b, 2u);
    EXPECT_NEAR(c.gap, 2, 1e-12);
    EXPECT_NEAR(c.normal.x, -1, 1e-12);
    EXPECT_NEAR(simulation.closest(0, 1).gap, 1.5, 1e-12);
    EXPECT_NEAR(simulation.closest(0, 2).gap, 1.5, 1e-12);
}

TEST_P(SimulationQueries, AnswerForWhereTheBodiesAreNow) {
    Simulation simulation(in_the_air(), colliders(), GetParam());
    const auto height = [&](double x) {
        const auto hit = simulation.cast_ray({x, 10, 0}, -Vector::UnitY());
        return hit ? 10 - hit->distance : -1;
    };
    EXPECT_NEAR(height(0), 2.5, 1e-12) << "before the first step";
    EXPECT_NEAR(simulation.closest(0, 1).gap, 1.5, 1e-12);
    simulation.set_placement(1, {{0, 4, 0}, Rotation::Identity()});
    EXPECT_NEAR(height(0), 4.5, 1e-12);
    simulation.set_velocity(1, {0, -10, 0}, Vector::Zero());
    simulation.step();
    EXPECT_NEAR(height(0), 4.4, 1e-9) << "at the end of the step";
    EXPECT_NEAR(simulation.closest(0, 1).gap, 3.4, 1e-9);
    BodySpec ball;
    ball.geometry = 1, ball.placement.position = {-3, 1, 0};
    const std::uint32_t third = simulation.add_body(ball);
    EXPECT_NEAR(height(-3), 1.5, 1e-12);
    EXPECT_NEAR(simulation.closest(third, 0).gap, 0.5, 1e-12);
    simulation.remove_body(third);
    EXPECT_NEAR(height(-3), 0, 1e-12);
    const std::string start = simulation.save();
    simulation.step();
    EXPECT_NEAR(height(0), 4.3, 1e-9);
    simulation.restore(start);
    EXPECT_NEAR(height(0), 4.4, 1e-9);
}

TEST_P(SimulationQueries, TellWhatAShapeWouldTouch) {
    Simulation simulation(in_the_air(), colliders(), GetParam());
    using Found = std::vector<std::uint32_t>;
    const auto touched = [&](const Vector& at, std::uint32_t mask = ~0u) {
        return simulation.overlaps(1, {at, Rotation::Identity()}, mask);
    };
    EXPECT_EQ(touched({1.2, 2, 0}), Found{}) << "between the ball and the cube";
    EXPECT_EQ(touched({0.9, 2, 0}), Found{1});
    EXPECT_EQ(touched({0.9, 2, 0}, ~2u), Found{}) << "the ball is of group 2";
    EXPECT_EQ(touched({2.1, 2, 0}), Found{2});
    EXPECT_EQ(touched({0.6, 0.4, 0}), Found{0});
    EXPECT_EQ(touched({0.4, 1.1, 0}), Found{1});
    const std::uint32_t large = simulation.add_geometry(box(3, 2.2, 1));
    EXPECT_EQ(simulation.overlaps(large, {{1.5, 2, 0}, Rotation::Identity()}), (Found{0, 1, 2}));
    simulation.remove_body(1);
    EXPECT_EQ(touched({0.9, 2, 0}), Found{});
    EXPECT_THROW(simulation.overlaps(99, {}), std::out_of_range);
    EXPECT_THROW(simulation.overlaps(0, {{NAN, 0, 0}, Rotation::Identity()}),
                 std::invalid_argument);
}

TEST_P(SimulationQueries, CastShapes) {
    Simulation simulation(in_the_air(), colliders(), GetParam());
    const std::uint32_t ball = simulation.add_geometry(sphere(0.25));
    const auto cast = [&](std::uint32_t geometry, const Vector& from, const Vector& along,
                          double length = 20, std::uint32_t mask = ~0u) {
        return simulation.cast_shape(geometry, {from, Rotation::Identity()}, along, length, mask);
    };
    // a ball on a ball: centres 0.75 m apart
    const auto on_ball = cast(ball, {0.3, 10, 0}, -Vector::UnitY());
    ASSERT_TRUE(on_ball);
    const double above = std::sqrt(0.75 * 0.75 - 0.3 * 0.3);
    EXPECT_EQ(on_ball->body, 1u);
    EXPECT_NEAR(on_ball->distance, 8 - above, 1e-8);
    EXPECT_NEAR((on_ball->normal - Vector(0.3, above, 0) / 0.75).norm(), 0, 1e-6);
    EXPECT_NEAR((on_ball->point - Vector(0, 2, 0) - 0.5 * on_ball->normal).norm(), 0, 1e-6);
    // past it, just so, and not
    EXPECT_EQ(cast(ball, {0.7499, 10, 0}, -Vector::UnitY())->body, 1u);
    EXPECT_EQ(cast(ball, {0.7501, 10, 0}, -Vector::UnitY())->body, 0u);
    EXPECT_NEAR(cast(ball, {0.7501, 10, 0}, -Vector::UnitY())->distance, 9.75, 1e-8);
    // what it may not meet, and how far it goes
    EXPECT_EQ(cast(ball, {0, 10, 0}, -Vector::UnitY(), 20, ~2u)->body, 0u);
    EXPECT_FALSE(cast(ball, {0, 10, 0}, -Vector::UnitY(), 7.24));
    EXPECT_TRUE(cast(ball, {0, 10, 0}, -Vector::UnitY(), 7.26));
    EXPECT_FALSE(cast(ball, {0, 10, 0}, Vector::UnitY()));
    // askew onto the ground, along it, and out of what it overlaps
    const Vector askew = Vector(3, -4, 0) / 5;
    EXPECT_NEAR(cast(ball, {-20, 8.25, 0}, askew)->distance, 10, 1e-8);
    EXPECT_EQ(cast(ball, {-20, 0.25, 0}, Vector::UnitX(), 19), std::nullopt);
    EXPECT_EQ(cast(ball, {0.6, 2, 0}, Vector::UnitX())->distance, 0);
    // a cube against the cube's edge
    const auto on_cube = cast(2, {3.9, 8, 0.9}, -Vector::UnitY());
    ASSERT_TRUE(on_cube);
    EXPECT_EQ(on_cube->body, 2u);
    EXPECT_NEAR(on_cube->distance, 5, 1e-8);
    EXPECT_THROW(cast(99, Vector::Zero(), Vector::UnitX()), std::out_of_range);
    EXPECT_THROW(cast(ball, Vector::Zero(), {1, 1, 0}), std::invalid_argument);
    EXPECT_THROW(cast(ball, Vector::Zero(), Vector::UnitX(), INFINITY), std::invalid_argument);
}

/// Where a cast ends the shape touches, and nowhere before: shapes and ways at random.
TEST_P(SimulationQueries, CastShapesUpToWhereTheyTouch) {
    Random random(11);
    const auto shape = [&](int kind) {
        const double r = random.number(0.1, 0.5);
        if (kind == 0) return sphere(r);
        if (kind == 1) return capsule(r, random.number(0.1, 0.6));
        return box(r, random.number(0.1, 0.6), random.number(0.1, 0.6));
    };
    int hits = 0;
    for (int draw = 0; draw < 60; ++draw) {
        Scene s;
        add_body(s, shape(draw % 3), random.vector(0.2), Motion::fixed).placement.rotation =
            random.rotation();
        add_body(s, shape(draw / 3 % 3), {50, 0, 0});
        Simulation simulation(s, colliders(), GetParam());
        const Vector out = random.direction();
        Placement from{3 * out + random.vector(0.3), random.rotation()};
        const auto hit = simulation.cast_shape(1, from, -out, 6);
        const auto gap = [&](double way) {
            Placement at = from;
            at.position -= way * out;
            simulation.set_placement(1, at);
            return simulation.closest(0, 1).gap;
        };
        SCOPED_TRACE(testing::Message() << "draw " << draw);
        const double length = hit ? hit->distance : 6;
        for (int i = 0; i < 20; ++i) EXPECT_GT(gap(length * i / 20.0), 1e-9);
        if (!hit) continue;
        ++hits;
        EXPECT_NEAR(gap(length), 0, 1e-6);
        EXPECT_LT(hit->normal.dot(-out), 0) << "it faces the shape";
    }
    EXPECT_GT(hits, 30);
}

/// Questions between steps leave no trace in what the steps do.
TEST_P(SimulationQueries, ChangeNoBit) {
    Scene s = in_the_air();
    s.settings.gravity = {0, -9.81, 0};
    for (int i = 0; i < 12; ++i)
        add_body(s, box(0.2, 0.2, 0.2), {0.1 * i, 3 + 0.45 * i, 0.03 * (i % 3)});
    Simulation quiet(s, colliders(), GetParam()), asked(s, colliders(), GetParam());
    for (int i = 0; i < 150; ++i) {
        if (i % 3 == 0) asked.cast_ray({0.3, 10, 0}, -Vector::UnitY());
        if (i % 2 == 0) asked.overlaps(2, {{0.3, 0.02 * i, 0}, Rotation::Identity()});
        if (i % 5 == 0) asked.closest(1, 2);
        if (i % 7 == 0)
            asked.cast_shape(2, {{0.3, 9, 0}, Rotation::Identity()}, -Vector::UnitY(), 8);
        quiet.step(), asked.step();
        ASSERT_EQ(state_hash(asked.world()), state_hash(quiet.world())) << "step " << i;
    }
    EXPECT_EQ(asked.detect_stats().narrow_pairs, quiet.detect_stats().narrow_pairs);
}

TEST_P(SimulationQueries, ThrowASentenceWhereThereIsNoAnswer) {
    Simulation simulation(in_the_air(), colliders(), GetParam());
    EXPECT_THROW(simulation.closest(0, 3), std::out_of_range);
    EXPECT_THROW(simulation.closest(1, 1), std::invalid_argument);
    try {
        simulation.cast_ray({0, 9, 0}, {0, -2, 0});
        FAIL() << "a direction of length 2";
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("length 1"), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(All, SimulationQueries,
                         testing::Values("reference", "ode", "bullet", "fcl"),
                         [](const auto& param_info) { return param_info.param; });

/// Answers no questions but the one for contacts.
class NoQueries : public Proximity {
public:
    Status add(std::uint32_t, const ShapePlacement&) noexcept override { return ok_status(); }
    Status remove(std::uint32_t) noexcept override { return ok_status(); }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return ok_status(); }
    DetectStats stats() const noexcept override { return {}; }
    Status detect(const DetectRequest&, const ContactSink*, std::uint32_t) noexcept override {
        return ok_status();
    }
};

template <class Question>
void expect_refusal(Question&& question, const std::string& sentence) {
    try {
        question();
        FAIL() << "no exception";
    } catch (const ColliderError& error) {
        EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
}

TEST(SimulationOnABlindCollider, PassesOnWhatTheColliderSays) {
    NoQueries collider;
    Simulation simulation(in_the_air(), collider, "blind");
    simulation.step();
    expect_refusal([&] { simulation.closest(0, 1); }, "this collider has no closest points");
    expect_refusal(
        [&] {
            simulation.cast_ray({0, 9, 0}, -Vector::UnitY());
        },
        "this collider casts no rays");
}

}  // namespace
}  // namespace plumb::test
