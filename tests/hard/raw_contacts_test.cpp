// SPDX-License-Identifier: MIT
/// "contacts": "raw" runs on what a back-end itself reports: it is asked for in every step, held to
/// the same checks as other contacts, and refused where a collider does not tell it.
#include "scene/error.h"
#include "support/scenes.h"

#include <vector>

namespace plumb::test {
namespace {

/// A ball of 0.5 m on the ground y = 0. Notes what it is asked, and may know no raw answers.
class Listener final : public Proximity {
public:
    bool knows_raw = true;
    double extra_gap = 0;  ///< by which its contact is said to be farther than it is [m]
    std::vector<std::uint32_t> flags;
    int bodies = 0;

    Status add(std::uint32_t, const ShapePlacement&) noexcept override {
        return ++bodies, ok_status();
    }
    Status remove(std::uint32_t) noexcept override { return --bodies, ok_status(); }
    Status exclude(std::uint32_t, std::uint32_t, bool) noexcept override { return ok_status(); }
    DetectStats stats() const noexcept override { return {}; }
    Status detect(const DetectRequest& request, const ContactSink* sinks,
                  std::uint32_t) noexcept override {
        flags.push_back(request.flags);
        if ((request.flags & kDetectRaw) && !knows_raw)
            return {Status::unsupported, 0, "its answers are clipped"};
        const Vec3 x = request.poses[1].position;
        Contact c{};
        c.a = 0, c.b = 1;
        c.normal = {0, -1, 0};
        c.point_a = {x.x, 0, x.z};
        c.point_b = x;
        c.radius_b = 0.5;
        c.gap = x.y - 0.5 + extra_gap;
        Contact* room = sinks[0].grow(sinks[0].ctx, 1);
        if (!room) return {Status::out_of_memory, 1, "no room"};
        *room = c;
        return ok_status();
    }
};

Scene ball_on_ground(ContactOrigin contacts) {
    Scene s;
    s.settings.contacts = contacts;
    add_ground(s);
    add_body(s, sphere(0.5), {0, 0.5, 0});
    return s;
}

TEST(RawContacts, AreAskedForInEveryStepAndOnlyWhereTheSettingSaysSo) {
    for (const auto& [contacts, flags] :
         {std::pair{ContactOrigin::shared, 0u}, {ContactOrigin::raw, std::uint32_t{kDetectRaw}}}) {
        Listener listener;
        Simulation simulation(ball_on_ground(contacts), listener);
        for (int i = 0; i < 5; ++i) simulation.step();
        ASSERT_GE(listener.flags.size(), 5u);
        for (const std::uint32_t asked : listener.flags) EXPECT_EQ(asked, flags);
    }
}

TEST(RawContacts, OfAColliderThatHasNoneAreRefused) {
    Listener listener;
    listener.knows_raw = false;
    try {
        Simulation simulation(ball_on_ground(ContactOrigin::raw), listener, "clipper");
        FAIL() << "it runs";
    } catch (const ColliderError& e) {
        EXPECT_STREQ(e.what(),
                     "collider \"clipper\" does not tell what its back-end itself reports, which "
                     "\"contacts\": \"raw\" asks for: its answers are clipped");
    }
    EXPECT_EQ(listener.bodies, 0) << "it is left with bodies";
    Simulation simulation(ball_on_ground(ContactOrigin::shared), listener, "clipper");
    EXPECT_FALSE(simulation.step().collider_failed);
}

TEST(RawContacts, OutsideOfTheMarginAreLeftOutAndCounted) {
    Listener listener;
    listener.extra_gap = 0.1;
    Simulation simulation(ball_on_ground(ContactOrigin::raw), listener);
    const StepReport report = simulation.step();
    EXPECT_EQ(report.contacts, 0u);
    EXPECT_EQ(report.rejected_contacts, 1u);
    EXPECT_EQ(report.faults[static_cast<std::size_t>(ContactFault::too_far)], 1u);
}

TEST(RawContacts, OfOverlapsAloneAreNotKept) {
    Listener listener;
    Simulation simulation(ball_on_ground(ContactOrigin::raw), listener);
    EXPECT_FALSE(simulation.plan().runs(Effect::contact_reuse));
}

TEST(RawContacts, WithoutFeaturesHandTheirImpulsesOn) {
    Listener listener;
    Simulation simulation(ball_on_ground(ContactOrigin::raw), listener);
    run_for(simulation, 1);
    const World& world = simulation.world();
    ASSERT_EQ(world.contacts.memory.size(), 1u);
    EXPECT_TRUE(world.contacts.memory[0].matched);
    EXPECT_NEAR(world.bodies.position[1].y(), 0.5, 1e-4);
}

class RawOnEveryCollider : public OnEveryCollider {
protected:
    Scene raw_scene() const {
        Scene s = scene();
        s.settings.contacts = ContactOrigin::raw;
        add_ground(s);
        return s;
    }
};
INSTANTIATE_TEST_SUITE_P(, RawOnEveryCollider, every_collider(), where_name);

TEST_P(RawOnEveryCollider, HoldASphereAndABoxOnAPlane) {
    Scene s = raw_scene();
    add_body(s, sphere(0.5), {0, 0.5, 0});
    add_body(s, box(0.5, 0.3, 0.4), {3, 0.3, 0});
    Simulation simulation(s, colliders(), collider());
    run_for(simulation, 3);
    const Bodies& bodies = simulation.world().bodies;
    EXPECT_NEAR(bodies.position[1].y(), 0.5, 2e-3);
    // Bullet itself tells one corner at a time, so that a box rocks
    EXPECT_NEAR(bodies.position[2].y(), 0.3, 0.02);
    EXPECT_NEAR(bodies.position[2].x(), 3, 0.02) << "the box wanders";
    EXPECT_EQ(simulation.world().contacts.rejected, 0u);
}

TEST_P(RawOnEveryCollider, GiveTheSameBitsOnAnyThreads) {
    Scene s = raw_scene();
    for (int i = 0; i < 60; ++i)
        add_body(s, i % 3 ? box(0.2, 0.15, 0.2) : sphere(0.2),
                 {0.41 * (i % 4) + 0.01 * (i / 16), 0.2 + 0.35 * (i / 16), 0.41 * (i / 4 % 4)});
    std::vector<std::uint64_t> hashes;
    for (const std::uint32_t threads : {1u, 2u}) {
        s.settings.threads = threads;
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 0.2);
        hashes.push_back(state_hash(simulation.world()));
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace plumb::test
