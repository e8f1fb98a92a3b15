// SPDX-License-Identifier: MIT
/// What gnuplot reads of a chart: a file of numbers, and a script that draws it twice.
#pragma once

#include "output/chart_stage.h"

#include <string>

namespace plumb {

/// Blocks of "x y", two blank lines between them: front, then for each series points and failures.
std::string chart_data(const Chart& chart, const ChartStage& stage);

/// Reads NAME.dat and writes NAME.svg and NAME.png, all in the folder where gnuplot runs.
std::string chart_script(const std::string& name, const Chart& chart, const ChartStage& stage);

/// Any text as a string of gnuplot in which nothing is expanded.
std::string gnuplot_string(const std::string& text);

}  // namespace plumb
