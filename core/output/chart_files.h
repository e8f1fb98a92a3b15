// SPDX-License-Identifier: MIT
/// A chart as files for papers: its numbers, a script for gnuplot, and what gnuplot draws of them.
///
/// gnuplot is looked for when a chart is written. Without it the numbers and the script are there
/// all the same, and can be drawn elsewhere.
#pragma once

#include <string>
#include <vector>

namespace plumb {

/// A point of a chart; a line breaks where one of the two is no finite number.
struct ChartPoint {
    double x = 0, y = 0;
};

/// One line. Looks that are not chosen (-1) follow from its place among the series.
struct ChartSeries {
    std::string name;
    std::vector<ChartPoint> points;  ///< in the order in which they are joined
    std::vector<double> failures;    ///< x of what failed: crosses in a band above the chart
    int color = -1;                  ///< index into nine colours that colour-blind eyes tell apart
    int mark = -1;                   ///< index into five marks
    int dash = -1;                   ///< index into four dashes; 0: unbroken
    bool stairs = false;             ///< joined by stairs and without marks, as a profile is
};

/// A level that holds for the whole chart, such as a tolerance.
struct ChartRule {
    std::string name;
    double y = 0;
};

/// Texts may hold anything; what breaks a line is taken for a space.
struct Chart {
    std::string title, x_label, y_label;  ///< labels with their units: "error [m]"
    bool log_x = true, log_y = true;      ///< values ≤ 0 then cannot be drawn
    std::vector<ChartSeries> series;
    std::vector<ChartPoint> front;  ///< Pareto front by rising x: bold stairs beneath the lines
    std::vector<ChartRule> rules;   ///< dashed
    std::string caption;            ///< under the chart: machine, flags, version
};

/// What became of a chart.
struct ChartFiles {
    std::vector<std::string> written;  ///< paths of all files that are there now
    std::string trouble;               ///< a sentence when it was not drawn; else ""
};

/// Writes NAME.dat and NAME.gp to the folder, and lets gnuplot make NAME.svg and NAME.png of them;
/// characters that `name` should not have become "-". Throws OutputError where the folder cannot be
/// written. `program`: the gnuplot to run, a path or a name to look for.
ChartFiles write_chart_files(const std::string& folder, const std::string& name, const Chart& chart,
                             const std::string& program = "gnuplot");

}  // namespace plumb
