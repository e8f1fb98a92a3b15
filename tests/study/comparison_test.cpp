// SPDX-License-Identifier: MIT
/// Colliders compared from a program: verdict, rows, free runs, and how a watch ends them.
#include "study/comparison.h"

#include "study/comparison_rows.h"
#include "study/free_run.h"
#include "support/scenes.h"

#include <memory>

namespace plumb::study {
namespace {

/// A box that lies on the ground, and what asks two colliders about it.
class Compared : public testing::Test {
protected:
    Compared() {
        add_ground(scene_);
        add_body(scene_, box(0.5, 0.5, 0.5), {0, 0.5, 0});
        scene_.settings.duration = 0.1;
        for (const char* name : {"reference", "ode"})
            sources_.push_back(std::make_unique<LocalSource>(scene_, test::colliders(), name));
        simulation_ = std::make_unique<Simulation>(scene_, test::colliders(), "reference");
    }

    ComparisonPlan plan() { return {scene_, sources_, {false, false}, 0, 1}; }

    Scene scene_;
    std::vector<std::unique_ptr<ContactSource>> sources_;
    std::unique_ptr<Simulation> simulation_;
};

TEST_F(Compared, ABoxOnTheGroundIsTheSameToAll) {
    const ComparisonResult result = compare_colliders(plan(), *simulation_);
    EXPECT_TRUE(result.agrees());
    EXPECT_FALSE(result.was_interrupted);
    EXPECT_EQ(result.poses, result.steps + 1);
    ASSERT_EQ(result.pairs.size(), 1u);
    EXPECT_GT(result.colliders[1].clipped.contacts, 0u);
    for (const Finding& f : findings_of(result)) EXPECT_FALSE(f.judged) << difference_text(f);
}

TEST_F(Compared, AWatchIsToldOfEachStepAndMayEndIt) {
    std::uint64_t told = 0;
    const auto watch = [&](std::uint64_t step, std::uint32_t contacts, bool agree) {
        EXPECT_EQ(step, ++told);
        EXPECT_EQ(contacts, 4u);
        EXPECT_TRUE(agree);
        return step < 3;
    };
    const ComparisonResult result = compare_colliders(plan(), *simulation_, watch);
    EXPECT_TRUE(result.was_interrupted);
    EXPECT_EQ(result.steps, 3u);
}

TEST_F(Compared, FreeRunsStartTogetherAndEndWhereTheyAreTold) {
    const FreeRuns runs = free_runs(scene_, test::colliders(), sources_, {false, false},
                                    [](std::uint64_t step, std::uint32_t) { return step < 4; });
    EXPECT_TRUE(runs.was_interrupted);
    ASSERT_EQ(runs.drifts.size(), 1u);
    EXPECT_EQ(runs.drifts[0].largest.front(), 0);
    EXPECT_EQ(runs.times.size(), runs.drifts[0].largest.size());
}

}  // namespace
}  // namespace plumb::study
