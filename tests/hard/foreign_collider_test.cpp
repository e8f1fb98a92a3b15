// SPDX-License-Identifier: MIT
/// A collider of one's own, by deriving from Proximity; and what the solver does with a bad one.
#include "support/scenes.h"

#include <cmath>
#include <limits>

namespace plumb::test {
namespace {

/// Knows one thing: balls of 0.5 m on the ground y = 0. Can be told to lie.
class GroundOnly : public Proximity {
public:
    enum class Lie { none, not_a_number, unknown_body, failure } lie = Lie::none;

    Status add(std::uint32_t, const ShapePlacement&) noexcept override { return ok_status(); }
    Status remove(std::uint32_t) noexcept override { return ok_status(); }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return ok_status(); }
    DetectStats stats() const noexcept override { return {}; }
    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t) noexcept override {
        for (std::uint32_t i = 1; i < request.body_count; ++i) {
            const Vec3 x = request.poses[i].position;
            const double gap = x.y - 0.5;
            if (gap > request.margin) continue;
            Contact c{};
            c.a = 0, c.b = lie == Lie::unknown_body ? 77 : i;
            c.feature = 1;
            c.normal = {0, -1, 0};
            c.point_a = {x.x, 0, x.z};
            c.point_b = x;
            c.radius_b = 0.5;
            c.gap = lie == Lie::not_a_number ? std::numeric_limits<double>::quiet_NaN() : gap;
            Contact* room = sinks[0].grow(sinks[0].ctx, 1);
            if (!room) return {Status::out_of_memory, 1, "no room"};
            *room = c;
        }
        if (lie == Lie::failure) return {Status::failed, 1, "one pair was left out"};
        return ok_status();
    }
};

Scene ball_on_ground() {
    Scene s;
    add_ground(s);
    add_body(s, sphere(0.5), {0, 0.5, 0});
    return s;
}

TEST(ForeignCollider, HoldsABall) {
    GroundOnly ground;
    Simulation simulation(ball_on_ground(), ground);
    run_for(simulation, 2);
    EXPECT_NEAR(simulation.world().bodies.position[1].y(), 0.5, 1e-4);
}

TEST(ForeignCollider, ContactsThatAreNoNumbersOrOfNoBodyAreLeftOutAndCounted) {
    for (auto lie : {GroundOnly::Lie::not_a_number, GroundOnly::Lie::unknown_body}) {
        GroundOnly ground;
        ground.lie = lie;
        Simulation simulation(ball_on_ground(), ground);
        const StepReport report = simulation.step();
        EXPECT_TRUE(report.finite);
        EXPECT_EQ(report.rejected_contacts, 1u);
        EXPECT_EQ(report.contacts, 0u);
    }
}

TEST(ForeignCollider, AFailureIsReportedAndWhatWasFoundIsUsed) {
    GroundOnly ground;
    ground.lie = GroundOnly::Lie::failure;
    Simulation simulation(ball_on_ground(), ground);
    const StepReport report = simulation.step();
    EXPECT_TRUE(report.collider_failed);
    EXPECT_EQ(report.message, "one pair was left out");
    EXPECT_EQ(report.contacts, 1u);
}

}  // namespace
}  // namespace plumb::test
