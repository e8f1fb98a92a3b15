// SPDX-License-Identifier: MIT
/// What is read off a table, on tables whose answers are known.
#include "study/findings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plumb::study {
namespace {

/// A table of one subject.
StudyTable empty_table() {
    StudyTable table;
    SubjectSummary s;
    s.name = "case";
    s.metrics = {{"distance", "m", "a distance"}};
    s.orders = {.substeps = 2, .iterations = 0, .step = 0};
    table.subjects = {s};
    return table;
}

void add(StudyTable& table, const std::string& curve, double substeps, double error, double cost) {
    Row row;
    row.point.subject = "case";
    row.point.curve = curve;
    row.point.precision = "single";
    row.point.value = substeps;
    row.point.collider = "ode";
    row.point.contacts = "shared";
    row.status = Status::done;
    row.errors = {error};
    row.costs = {{cost, cost}, {3 * cost, cost}, {cost, cost}};
    table.rows.push_back(row);
}

/// error = 10⁻² / n², but not below 10⁻⁶; cost = 10 n.
StudyTable falling_table() {
    StudyTable table = empty_table();
    for (double n = 1; n <= 1024; n *= 2)
        add(table, "pbd", n, std::max(1e-2 / (n * n), 1e-6), 10 * n);
    return table;
}

TEST(Findings, CostIsTheMedianOfTheRuns) {
    const StudyTable table = falling_table();
    EXPECT_EQ(table.rows[3].median_cost().total, 80);
}

TEST(Findings, ASlopeIsThatOfThePartThatFalls) {
    const StudyTable table = falling_table();
    const auto slope = slope_of(table, curves_of(table)[0]);
    ASSERT_TRUE(slope);
    EXPECT_NEAR(slope->order, 2, 1e-9);
    EXPECT_EQ(slope->expected, 2);
    EXPECT_EQ(slope->from, 1);
    EXPECT_NEAR(slope->to, 64, 1e-9);
}

TEST(Findings, AFloorIsWhereACurveThatFellStops) {
    StudyTable table = falling_table();
    const auto floor = floor_of(table, curves_of(table)[0]);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(*floor, 1e-6, 1e-15);
    table = empty_table();
    for (double n = 1; n <= 64; n *= 2) add(table, "pbd", n, 0.5, n);
    EXPECT_FALSE(floor_of(table, curves_of(table)[0])) << "it never fell";
    EXPECT_FALSE(slope_of(table, curves_of(table)[0]));
}

TEST(Findings, TheFrontIsWhatNothingBeatsInBoth) {
    StudyTable table = empty_table();
    add(table, "pbd", 1, 1e-2, 10);
    add(table, "pbd", 2, 1e-3, 20);
    add(table, "pbd", 4, 2e-3, 30);
    add(table, "pbd", 8, 1e-4, 40);
    Row failed = table.rows[0];
    failed.status = Status::diverged;
    failed.costs = {{1, 1}};
    table.rows.push_back(failed);
    EXPECT_EQ(front_of(table), (std::vector<bool>{true, true, false, true, false}));
    EXPECT_EQ(cheapest(table, "case", 2e-3), 1u);
    EXPECT_EQ(cheapest(table, "case", 1e-5), std::nullopt);
}

TEST(Findings, AdviceNamesNoDepartureAndNoRawContacts) {
    StudyTable table = empty_table();
    add(table, "without warm start", 1, 1e-9, 1);
    add(table, "pbd", 8, 1e-3, 40);
    EXPECT_EQ(cheapest(table, "case", 1), 1u);
    const auto sentences = advice_on(table, table.subjects[0]);
    ASSERT_FALSE(sentences.empty());
    EXPECT_EQ(sentences[0],
              "1 mm costs 40 µs of CPU a simulated second: 8 substeps × 1 iteration in single, on "
              "ode");
}

/// A smaller accuracy is a finer one, as a smaller step is.
TEST(Findings, AnAccuracyIsFinerTheSmallerItIs) {
    StudyTable table = empty_table();
    for (const double accuracy : {0.001, 1.0, 0.1, 0.01}) {
        add(table, "pbd", accuracy, 1e-2 * accuracy, 10 / accuracy);
        table.rows.back().point.ladder = Ladder::accuracy;
    }
    const std::vector<CurveRows> curves = curves_of(table);
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_EQ(curves[0].rows, (std::vector<std::size_t>{1, 2, 3, 0}));
    const auto slope = slope_of(table, curves[0]);
    ASSERT_TRUE(slope);
    EXPECT_NEAR(slope->order, 1, 1e-9);
    EXPECT_EQ(slope->expected, 0);
    EXPECT_NEAR(slope->from, 1, 1e-9);
    EXPECT_NEAR(slope->to, 0.001, 1e-9);
    EXPECT_EQ(advice_on(table, table.subjects[0]).back(),
              "10 µm costs 10000 µs of CPU a simulated second: an accuracy of 0.001 in single, on "
              "ode");
}

TEST(Findings, AGainIsTheRatioOfErrorsAtEqualCost) {
    StudyTable table = falling_table();
    for (double n = 1; n <= 32; n *= 2)
        add(table, "without warm start", n, 5 * 1e-2 / (n * n), 10 * n);
    const auto curves = curves_of(table);
    const auto found = gain(table, curves[0], curves[1]);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->ratio, 5, 1e-9);
    EXPECT_NEAR(found->from, 10, 1e-9);
    EXPECT_NEAR(found->to, 320, 1e-9);
    const auto departures = departures_of(table);
    ASSERT_EQ(departures.size(), 1u);
    EXPECT_EQ(departures[0].what, "warm start");
}

TEST(Findings, AProfileCountsSubjectsByHowMuchDearerTheyAre) {
    StudyTable table = empty_table();
    table.subjects[0].tolerance = 1e-3;
    add(table, "pbd", 4, 1e-3, 10);
    add(table, "paper", 8, 1e-3, 40);
    add(table, "paper", 1, 1e-1, 1);
    const auto profiles = profiles_of(table);
    ASSERT_EQ(profiles.size(), 2u);
    EXPECT_EQ(profiles[0].points, (std::vector<std::pair<double, double>>{{4, 1}}));
    EXPECT_EQ(profiles[1].points, (std::vector<std::pair<double, double>>{{1, 1}}));
}

}  // namespace
}  // namespace plumb::study
