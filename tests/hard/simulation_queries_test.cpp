// SPDX-License-Identifier: MIT
/// Rays and closest points through the facade, on every plugin, against closed forms; and what is
/// thrown where there is no answer.
#include "scene/error.h"
#include "support/scenes.h"

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

TEST_P(SimulationQueries, ThrowASentenceWhereThereIsNoAnswer) {
    Simulation simulation(in_the_air(), colliders(), GetParam());
    EXPECT_THROW(simulation.closest(0, 1), std::logic_error) << "before the first step";
    EXPECT_THROW(simulation.cast_ray({0, 9, 0}, -Vector::UnitY()), std::logic_error);
    simulation.step();
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
