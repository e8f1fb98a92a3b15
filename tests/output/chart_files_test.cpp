// SPDX-License-Identifier: MIT
#include "output/chart_files.h"

#include "output/chart_script.h"
#include "output/error.h"
#include "output/file.h"
#include "temporary_folder.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace plumb::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Lines that fall with different slopes; some fail at their cheapest.
Chart falling_lines(const std::string& text) {
    Chart chart;
    chart.title = "Error of a pendulum against the cost of its motion " + text;
    chart.x_label = "CPU time per simulated second [µs] " + text;
    chart.y_label = "largest error of the angle [rad] " + text;
    chart.caption = "Measured on some processor, built with -O3; version 1.0 " + text;
    chart.rules = {{"tolerance 0.003 rad " + text, 3e-3}};
    for (int i = 0; i < 6; ++i) {
        ChartSeries series{"line " + std::to_string(i) + " · single · substeps " + text, {}, {}};
        for (int k = 0; k < 8; ++k) {
            const double n = std::exp2(k);
            series.points.push_back({(3 + i) * (4 + n), 0.5 * (1 + i) * std::pow(n, -1 - 0.2 * i)});
        }
        if (i > 2) series.failures = {11.0 + i, 15.0 + i};
        chart.series.push_back(series);
    }
    chart.front = {{15, 0.5}, {27, 0.1}, {60, 0.04}, {400, 1e-3}};
    return chart;
}

class ChartFilesTest : public TemporaryFolder {};

bool has_gnuplot() {
    return std::system("gnuplot --version >/dev/null 2>&1") ==
           0;  // NOLINT(bugprone-command-processor)
}

TEST_F(ChartFilesTest, WithoutGnuplotNumbersAndScriptAreThereAndASentenceSaysSo) {
    const ChartFiles files =
        write_chart_files(path(""), "pendulum cost", falling_lines(""), "no-such-gnuplot");
    EXPECT_THAT(files.trouble, HasSubstr("there is no gnuplot here"));
    EXPECT_EQ(files.written,
              (std::vector<std::string>{path("pendulum-cost.dat"), path("pendulum-cost.gp")}));
    EXPECT_THAT(read_file(path("pendulum-cost.gp")), HasSubstr("'pendulum-cost.dat' index 1 "));
    EXPECT_THAT(read_file(path("pendulum-cost.dat")), HasSubstr("\n15 0.5\n"));
}

TEST_F(ChartFilesTest, ALongLabelTakesTwoLines) {
    Chart chart = falling_lines("");
    chart.y_label = "largest distance of the lower tip from where it should be at any time [m]";
    write_chart_files(path(""), "a", chart, "no-such-gnuplot");
    EXPECT_THAT(read_file(path("a.gp")),
                HasSubstr("set ylabel 'largest distance of the lower tip from"));
    EXPECT_THAT(read_file(path("a.gp")), HasSubstr("'.\"\\n\".'"));
}

TEST_F(ChartFilesTest, AFolderThatIsNotThereIsAnError) {
    EXPECT_THROW(write_chart_files(path("nowhere"), "a", falling_lines("")), OutputError);
}

TEST_F(ChartFilesTest, GnuplotThatFailsIsReportedAndItsComplaintKept) {
    write("bad", "#!/bin/sh\necho >&2 'line 3: unknown terminal'\nexit 1\n");
    std::filesystem::permissions(path("bad"), std::filesystem::perms::owner_all);
    const ChartFiles files = write_chart_files(path(""), "a", falling_lines(""), path("bad"));
    EXPECT_THAT(files.trouble, HasSubstr("gnuplot failed (line 3: unknown terminal)"));
    EXPECT_EQ(files.written.size(), 2u);
    EXPECT_FALSE(std::filesystem::exists(path("a.gp.log")));
}

TEST_F(ChartFilesTest, WhatCannotBeDrawnBreaksTheLine) {
    Chart chart;
    chart.series = {{"a", {{1, kNan}, {2, 3}, {3, 0}, {4, 5}, {kNan, 5}}, {-1, kNan}},
                    {"empty\nname", {}, {}}};
    const ChartStage stage = chart_stage(chart);
    EXPECT_EQ(stage.top, stage.y.high);
    EXPECT_EQ(chart_data(chart, stage),
              "# Pareto front\nNaN NaN\n\n\n# a\n2 3\n\n4 5\n\n\n# failures of a\nNaN NaN\n\n\n"
              "# empty name\nNaN NaN\n\n\n# failures of empty name\nNaN NaN\n\n\n");
}

TEST(ChartStage, FailuresStandInTheBandAboveAllErrors) {
    const Chart chart = falling_lines("");
    const ChartStage stage = chart_stage(chart);
    for (const ChartSeries& series : chart.series) {
        for (const ChartPoint& point : series.points) EXPECT_LT(point.y, stage.y.high);
    }
    std::size_t count = 0;
    for (const std::vector<ChartPoint>& failures : stage.failures) {
        for (const ChartPoint& failure : failures) {
            EXPECT_GT(failure.y, stage.y.high);
            EXPECT_LT(failure.y, stage.top);
            EXPECT_GT(failure.x, stage.x.low);
            ++count;
        }
    }
    EXPECT_EQ(count, 6u);
}

TEST(ChartScript, TextsAreStringsInWhichNothingIsExpanded) {
    EXPECT_EQ(gnuplot_string("it's {/Bold a_b} \"c\"\n\\"), "'it\u2019s {/Bold a_b} \"c\" \\'");
    EXPECT_EQ(gnuplot_string("''''").substr(1).find('\''), 12u);
    EXPECT_EQ(gnuplot_string("`date`").find('`'), std::string::npos);
}

TEST_F(ChartFilesTest, GnuplotDrawsBothPicturesWhateverTheTextsSay) {
    if (!has_gnuplot()) GTEST_SKIP() << "there is no gnuplot here";
    const std::string evil =
        "'; system('touch hit') ; '' `touch hit` \"`touch hit`\" $(touch hit) "
        "@x {/Bold _^} % \\ <b>&</b> \n system 'touch hit'";
    for (const std::string& text : {std::string(), evil}) {
        const ChartFiles files = write_chart_files(path(""), "chart", falling_lines(text));
        EXPECT_EQ(files.trouble, "");
        ASSERT_EQ(files.written.size(), 4u);
        EXPECT_THAT(read_file(path("chart.svg")), HasSubstr("</svg>"));
        EXPECT_GT(std::filesystem::file_size(path("chart.png")), 10'000u);
        EXPECT_FALSE(std::filesystem::exists(path("hit")));
    }
    EXPECT_THAT(read_file(path("chart.svg")), HasSubstr("&lt;b>&amp;&lt;"));
}

TEST_F(ChartFilesTest, EmptyAndLinearChartsAreDrawnToo) {
    if (!has_gnuplot()) GTEST_SKIP() << "there is no gnuplot here";
    EXPECT_EQ(write_chart_files(path(""), "empty", {}).trouble, "");
    Chart profile;
    profile.log_y = false;
    profile.series = {{"pbd single", {{1, 0.2}, {2, 0.6}, {8, 1}}, {}}};
    profile.series[0].stairs = true;
    EXPECT_EQ(write_chart_files(path(""), "profile", profile).trouble, "");
}

}  // namespace
}  // namespace plumb::test
