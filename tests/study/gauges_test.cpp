// SPDX-License-Identifier: MIT
/// Gauges of contacts, on tables of contacts with gaps and impulses that are made up.
#include "study/gauges.h"

#include "effects/plan.h"
#include "support/scenes.h"

namespace plumb::study {
namespace {

class Gauges : public testing::Test {
protected:
    Gauges() {
        Scene scene;
        scene.materials[0].friction = 0.5;
        add_ground(scene);
        add_body(scene, box(0.5, 0.5, 0.5), {0, 0.5, 0});
        simulation_ = std::make_unique<Simulation>(scene, test::colliders(), "reference");
        world_ = simulation_->world();
        world_.steps = 1;
    }

    /// A contact of the step that was made last.
    void add(double gap, double push, double friction) {
        Contact contact{};
        contact.a = 0, contact.b = 1, contact.gap = gap;
        ContactMemory memory{};
        memory.normal_impulse = push;
        memory.friction_impulse = {friction, 0, 0};
        world_.contacts.found.push_back(contact);
        world_.contacts.memory.push_back(memory);
    }

    double gauge(const std::string& name) const {
        for (const Metric& metric : gauges_of(simulation_->plan(), world_)) {
            if (metric.name != name) continue;
            const auto judge = metric.judge();
            judge->look(world_);
            return judge->error();
        }
        ADD_FAILURE() << "no gauge " << name;
        return -1;
    }

    std::unique_ptr<Simulation> simulation_;
    World world_;
};

TEST_F(Gauges, WithoutPushesAreZero) {
    EXPECT_EQ(gauge("complementarity"), 0);
    EXPECT_EQ(gauge("cone"), 0);
    add(0.1, 0, 0);
    EXPECT_EQ(gauge("complementarity"), 0);
    EXPECT_EQ(gauge("cone"), 0);
}

/// (1 mm · 3 + 0 · 1) / 4: overlaps count as no gap.
TEST_F(Gauges, TellTheMeanGapAtWhichContactsPush) {
    add(1e-3, 3, 0);
    add(-1e-2, 1, 0);
    EXPECT_NEAR(gauge("complementarity"), 0.75e-3, 1e-12);
}

/// (2.5 − 0.5 · 4) / (4 + 6): the second contact keeps within its cone.
TEST_F(Gauges, TellFrictionBeyondItsBound) {
    add(0, 4, 2.5);
    add(0, 6, -3);
    EXPECT_NEAR(gauge("cone"), 0.05, 1e-12);
}

/// A box at rest keeps to the law, until one of its contacts is said to push from afar.
TEST_F(Gauges, ReadTheContactsOfTheLastStep) {
    for (int i = 0; i < 50; ++i) simulation_->step();
    world_ = simulation_->world();
    ASSERT_FALSE(world_.contacts.found.empty());
    EXPECT_LT(gauge("complementarity"), 1e-5);
    world_.contacts.found[0].gap = 1;
    EXPECT_GT(gauge("complementarity"), 0.1);
}

}  // namespace
}  // namespace plumb::study
