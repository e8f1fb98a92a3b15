// SPDX-License-Identifier: MIT
/// The library of cases: each holds at its own settings what it says.
#include "study/cases.h"
#include "support/scenes.h"

#include <ostream>

namespace plumb::study {

void PrintTo(const CaseEntry& entry, std::ostream* out) { *out << entry.name; }

}  // namespace plumb::study

namespace plumb::test {
namespace {

class Case : public testing::TestWithParam<study::CaseEntry> {};
INSTANTIATE_TEST_SUITE_P(, Case, testing::ValuesIn(study::cases()),
                         [](const auto& which) { return std::string(which.param.name); });

TEST_P(Case, KeepsItsToleranceAtItsOwnSettings) {
    const study::Subject subject = GetParam().make();
    EXPECT_EQ(subject.name, GetParam().name);
    Simulation simulation(subject.scene, colliders(), "auto");
    const auto judge = subject.metrics.front().judge();
    judge->look(simulation.world());
    const auto steps = std::llround(subject.scene.settings.duration / subject.scene.settings.dt);
    for (long long i = 0; i < steps; ++i) {
        ASSERT_TRUE(simulation.step().finite);
        judge->look(simulation.world());
    }
    RecordProperty("error", std::to_string(judge->error()));
    EXPECT_LE(judge->error(), subject.tolerance) << subject.metrics.front().what;
    EXPECT_GT(judge->error(), subject.tolerance / 3) << "the tolerance says more than is measured";
}

}  // namespace
}  // namespace plumb::test
