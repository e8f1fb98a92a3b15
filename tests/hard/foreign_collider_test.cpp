// SPDX-License-Identifier: MIT
/// A collider of one's own, by deriving from Proximity; and what the solver does with a bad one.
#include "support/scenes.h"

#include <cmath>
#include <functional>
#include <limits>

namespace plumb::test {
namespace {

/// Knows one thing: balls of 0.5 m on the ground y = 0. What it says can be changed on the way.
class GroundOnly : public Proximity {
public:
    std::function<void(Contact&)> lie = [](Contact&) {};
    Status answer = ok_status();
    std::uint32_t asks_more = 0;  ///< contacts that it asks room for and does not write

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
            c.a = 0, c.b = i;
            c.feature = 1;
            c.normal = {0, -1, 0};
            c.point_a = {x.x, 0, x.z};
            c.point_b = x;
            c.radius_b = 0.5;
            c.gap = gap;
            lie(c);
            Contact* room = sinks[0].grow(sinks[0].ctx, 1 + asks_more);
            if (!room) return {Status::out_of_memory, 1, "no room"};
            *room = c;
        }
        return answer;
    }
};

TEST(ForeignCollider, HoldsABall) {
    GroundOnly ground;
    Simulation simulation(ball_on_ground(), ground);
    run_for(simulation, 2);
    EXPECT_NEAR(simulation.world().bodies.position[1].y(), 0.5, 1e-4);
}

/// A step of a scene on a collider that lies; its only contact is left out, for one fault.
void expect_fault(const Scene& scene, ContactFault fault, std::function<void(Contact&)> lie,
                  std::uint32_t count = 1) {
    GroundOnly ground;
    ground.lie = std::move(lie);
    Simulation simulation(scene, ground);
    const StepReport report = simulation.step();
    EXPECT_TRUE(report.finite);
    EXPECT_EQ(report.contacts, 0u);
    EXPECT_EQ(report.rejected_contacts, count);
    EXPECT_EQ(report.faults[static_cast<std::size_t>(fault)], count);
}

TEST(ForeignCollider, ContactsThatAreNoNumbersAreLeftOut) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = HUGE_VAL;
    const Scene s = ball_on_ground();
    for (double bad : {nan, infinity}) {
        expect_fault(s, ContactFault::not_finite, [=](Contact& c) { c.gap = bad; });
        expect_fault(s, ContactFault::not_finite, [=](Contact& c) { c.point_a.z = bad; });
        expect_fault(s, ContactFault::not_finite, [=](Contact& c) { c.normal.x = bad; });
        expect_fault(s, ContactFault::not_finite, [=](Contact& c) { c.radius_b = bad; });
    }
}

TEST(ForeignCollider, ContactsOfUnknownBodiesAreLeftOut) {
    const Scene s = ball_on_ground();
    expect_fault(s, ContactFault::unknown_body, [](Contact& c) { c.b = 77; });
    expect_fault(s, ContactFault::unknown_body, [](Contact& c) { c.a = c.b; });
    expect_fault(s, ContactFault::unknown_body, [](Contact& c) { std::swap(c.a, c.b); });
}

TEST(ForeignCollider, NormalsThatAreNotOfUnitLengthAreLeftOut) {
    for (double length : {0.0, 0.9, 1.001})
        expect_fault(ball_on_ground(), ContactFault::bad_normal,
                     [=](Contact& c) { c.normal.y = length; });
}

TEST(ForeignCollider, ContactsBeyondMarginAndSweepsAreLeftOut) {
    const Scene s = ball_on_ground();
    expect_fault(s, ContactFault::too_far, [&](Contact& c) { c.gap = 1.01 * s.settings.margin; });
    GroundOnly ground;
    ground.lie = [&](Contact& c) { c.gap = s.settings.margin; };
    Simulation simulation(s, ground);
    EXPECT_EQ(simulation.step().contacts, 1u) << "a gap of just the margin was asked for";

    Scene fast = ball_on_ground();
    fast.bodies[1].velocity = {0, -3, 0};  // 3 m/s sweep 3 dt, less half a margin
    const double sweep = 3 * fast.settings.dt - fast.settings.margin / 2;
    ground.lie = [&](Contact& c) { c.gap = fast.settings.margin + 0.99 * sweep; };
    Simulation swept(fast, ground);
    EXPECT_EQ(swept.step().contacts, 1u) << "the sweep widens what is asked for";
    expect_fault(fast, ContactFault::too_far,
                 [&](Contact& c) { c.gap = fast.settings.margin + 1.01 * sweep; });
}

TEST(ForeignCollider, ContactsOfPairsThatMustNotTouchAreLeftOut) {
    Scene filtered = ball_on_ground();
    filtered.bodies[1].group = 2, filtered.bodies[0].mask = 1;
    add_body(filtered, sphere(0.5), {0, 9, 0});  // which may touch the ground
    expect_fault(filtered, ContactFault::unwanted_pair, [](Contact&) {});

    Scene still = ball_on_ground();
    still.bodies[1].motion = Motion::kinematic;
    add_body(still, sphere(0.5), {0, 9, 0});
    expect_fault(still, ContactFault::unwanted_pair, [](Contact&) {});

    Scene shapeless = ball_on_ground();
    shapeless.bodies[1].geometry = kNoIndex;
    shapeless.bodies[1].mass = 1, shapeless.bodies[1].inertia = {1, 1, 1};
    add_body(shapeless, sphere(0.5), {0, 9, 0});
    expect_fault(shapeless, ContactFault::unwanted_pair, [](Contact&) {});

    Scene linked = ball_on_ground();
    add_body(linked, sphere(0.5), {0, 9, 0});
    linked.joints.push_back({});
    linked.joints[0].body_a = 1, linked.joints[0].body_b = 2;
    const auto between_balls = [](Contact& c) { c.a = 1, c.b = 2; };
    expect_fault(linked, ContactFault::unwanted_pair, between_balls);
    linked.joints[0].collide = true;
    GroundOnly ground;
    ground.lie = between_balls;
    Simulation simulation(linked, ground);
    EXPECT_EQ(simulation.step().contacts, 1u) << "this joint lets its bodies collide";
}

TEST(ForeignCollider, RoomThatIsNotWrittenToHoldsNoContactsOfOlderSteps) {
    GroundOnly ground;
    Simulation simulation(ball_on_ground(), ground);
    ground.asks_more = 3;
    EXPECT_EQ(simulation.step().contacts, 1u);
    const StepReport report = simulation.step();
    EXPECT_EQ(report.contacts, 1u);
    EXPECT_EQ(report.faults[static_cast<std::size_t>(ContactFault::unknown_body)], 3u);
}

TEST(ForeignCollider, AFailureIsReportedAndWhatWasFoundIsUsed) {
    GroundOnly ground;
    ground.answer = {Status::failed, 1, "one pair was left out"};
    Simulation simulation(ball_on_ground(), ground);
    const StepReport report = simulation.step();
    EXPECT_TRUE(report.collider_failed);
    EXPECT_EQ(report.message, "one pair was left out");
    EXPECT_EQ(report.contacts, 1u);
}

}  // namespace
}  // namespace plumb::test
