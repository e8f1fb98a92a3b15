// SPDX-License-Identifier: MIT
/// Where things stand in a chart: the ranges of its axes, and the band of failures above them.
#pragma once

#include "output/chart_files.h"

#include <vector>

namespace plumb {

constexpr int kPlotWidth = 900, kPlotHeight = 430;  ///< inside the frame [pixels]

/// One direction of a chart.
struct ChartAxis {
    bool log = false;
    double low = 0, high = 1;

    bool takes(double value) const;
    /// Share of the way from low to high.
    double share(double value) const;
    /// Value at a share of the way, which may lie beyond 1.
    double at(double share) const;
};

struct ChartStage {
    ChartAxis x, y;
    double top = 1;  ///< of y: above y.high where there is a band of failures
    std::vector<std::vector<ChartPoint>> failures;  ///< [series][failure], placed in the band
};

/// True for what a chart can show at all.
bool is_drawable(const ChartPoint& point, const Chart& chart);

ChartStage chart_stage(const Chart& chart);

}  // namespace plumb
