// SPDX-License-Identifier: MIT
/// The library of cases: each holds at its own settings what it says, on every collider, and its
/// judges look on whatever the steps are.
#include "study/measured.h"

#include "effects/plan.h"
#include "host/shape_pairs.h"

#include <algorithm>
#include <set>

namespace plumb::test {
namespace {

bool has_all_pairs(const std::string& collider, const Scene& scene) {
    const auto needs = shape_pair_needs(scene);
    return std::all_of(needs.begin(), needs.end(), [&](const ShapePairNeed& need) {
        return supports(*colliders().find(collider).table, need);
    });
}

class Case : public testing::TestWithParam<study::CaseEntry> {};
INSTANTIATE_TEST_SUITE_P(, Case, testing::ValuesIn(study::cases()),
                         [](const auto& which) { return std::string(which.param.name); });

TEST_P(Case, SaysWhatItIs) {
    const study::Subject subject = GetParam().make();
    EXPECT_EQ(subject.name, GetParam().name);
    EXPECT_EQ(study::find_case(subject.name)->make, GetParam().make);
    EXPECT_FALSE(subject.title.empty() || subject.reference.empty());
    std::set<std::string> names;
    for (const study::Metric& metric : subject.metrics)
        EXPECT_TRUE(names.insert(metric.name).second) << metric.name << " stands there twice";
    EXPECT_GT(subject.tolerance, 0);
}

TEST_P(Case, KeepsItsToleranceAtItsOwnSettings) {
    const study::Subject subject = GetParam().make();
    const std::vector<double> errors = errors_of(subject);
    for (std::size_t i = 0; i < errors.size(); ++i)
        RecordProperty("error_" + subject.metrics[i].name, testing::PrintToString(errors[i]));
    EXPECT_LE(errors[0], subject.tolerance) << subject.metrics[0].what;
    constexpr double kRest = 1e-9;  // below, errors are what the solver stops at, and chance
    if (subject.tolerance > kRest) {
        EXPECT_GT(errors[0], subject.tolerance / 3) << "the tolerance says more than is measured";
    }
}

TEST_P(Case, KeepsItOnEveryColliderAndInDouble) {
    study::Subject subject = GetParam().make();
    std::vector<std::string> names;
    if (has_all_pairs("reference", subject.scene)) names.emplace_back("reference");
    if (make_plan(build_world(subject.scene)).runs(Effect::contacts))
        names.insert(names.end(), {"ode", "bullet", "fcl"});
    for (const Precision precision : {Precision::single, Precision::double_})
        for (const std::string& collider : names) {
            subject.scene.settings.precision = precision;
            EXPECT_LE(errors_of(subject, collider)[0], subject.tolerance) << collider;
        }
}

/// At other steps, too, judges give a number for each metric.
TEST_P(Case, IsJudgedAtAnySteps) {
    struct Steps {
        double of_dt;
        std::uint32_t substeps, iterations;
    };
    for (const Steps& steps : {Steps{4, 1, 1}, {4, 20, 1}, {1, 1, 20}, {1.0 / 16, 1, 1}}) {
        study::Subject subject = GetParam().make();
        Settings& s = subject.scene.settings;
        s.dt *= steps.of_dt;
        s.duration = std::min(s.duration, 1.0);
        s.substeps = steps.substeps;
        s.velocity_iterations = s.position_iterations = steps.iterations;
        for (const double error : errors_of(subject)) {
            EXPECT_FALSE(std::isnan(error)) << s.dt << " s × " << s.substeps;
            EXPECT_GE(error, 0) << s.dt << " s × " << s.substeps;
        }
    }
}

TEST(Cases, HaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (const study::CaseEntry& entry : study::cases())
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name << " stands there twice";
    EXPECT_EQ(study::find_case("no such case"), nullptr);
}

}  // namespace
}  // namespace plumb::test
