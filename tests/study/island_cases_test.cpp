// SPDX-License-Identifier: MIT
/// What islands that are solved until they are right buy over iterations alone, in the cases that
/// statics knows.
#include "study/measured.h"

#include "reader/reader.h"
#include "study/sweep_plan.h"

#include <algorithm>

namespace plumb::test {
namespace {

double shift_of(const char* name, std::initializer_list<const char*> settings) {
    study::Subject subject = study::find_case(name)->make();
    for (const char* setting : settings) apply_setting(subject.scene.settings, setting);
    return errors_of(subject)[0];
}

/// One substep of one iteration, for iterations are not what holds it.
TEST(IslandCases, AnArchStandsToTwoBillionthsOfItsSpanWhereIterationsAloneLetItSag) {
    EXPECT_LT(shift_of("arch", {"substeps=1"}), 2e-9);
    const double swept = shift_of("arch", {"substeps=1", "exact_islands=0",
                                           "velocity_iterations=200", "position_iterations=200"});
    EXPECT_GT(swept, 1e-3);
    EXPECT_LT(swept, 1e-2);
    EXPECT_GT(shift_of("arch", {"substeps=1", "exact_islands=0", "velocity_iterations=10",
                                "position_iterations=10"}),
              1);
}

TEST(IslandCases, AWallBeyondExactIslandsStandsByItsAccuracyAlone) {
    EXPECT_GT(shift_of("wall", {"accuracy=0"}), 1);
    for (const char* accuracy : {"accuracy=1", "accuracy=0.001"})
        EXPECT_LT(shift_of("wall", {accuracy}), 1.5e-8) << accuracy;
}

TEST(IslandCases, IterationsAloneCarryNoTowerOfUnevenWeights) {
    EXPECT_GT(shift_of("tower", {"exact_islands=0"}), 0.1);
    EXPECT_LT(shift_of("tower", {"substeps=1"}), 1e-7);
}

/// The accuracy is varied where so many bodies move that an island may be beyond exact ones.
TEST(IslandCases, AccuracyIsSweptWhereIslandsMayBeLarge) {
    const auto has_accuracies = [](const char* name) {
        const auto points = study::points_of(study::find_case(name)->make(), {}, colliders());
        return std::any_of(points.begin(), points.end(), [](const study::Point& p) {
            return p.ladder == study::Ladder::accuracy;
        });
    };
    EXPECT_TRUE(has_accuracies("wall"));
    EXPECT_TRUE(has_accuracies("pile"));
    EXPECT_FALSE(has_accuracies("arch"));
    EXPECT_FALSE(has_accuracies("pendulum"));
}

}  // namespace
}  // namespace plumb::test
