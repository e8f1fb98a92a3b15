// SPDX-License-Identifier: MIT
#include "output/chart_stage.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr int kMostRows = 4;                            ///< of crosses in the band
constexpr double kCross = 13, kGap = 9, kRowStep = 14;  ///< [pixels]

/// An axis about the values, with room on both sides; some axis where there are none.
ChartAxis axis_about(const std::vector<double>& values, bool log, double room) {
    if (values.empty()) return {log, log ? 0.1 : 0, log ? 10.0 : 1};
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    if (log) {
        // At least a decade, so that some power of ten stands on the axis.
        const double middle = std::sqrt(*least) * std::sqrt(*most), half = std::sqrt(10);
        return {true, std::min(*least / room, middle / half),
                std::max(*most * room, middle * half)};
    }
    const double span = *most > *least ? *most - *least : std::max(std::abs(*most), 1.0);
    return {false, *least >= 0 && *least < 0.5 * span ? 0 : *least - 0.04 * span,
            *most + 0.04 * span};
}

struct Values {
    std::vector<double> x, y, failed;
};

/// All coordinates that the axes must hold.
Values drawn_values(const Chart& chart) {
    Values values;
    const auto add = [&](const ChartPoint& point) {
        if (!is_drawable(point, chart)) return;
        values.x.push_back(point.x);
        values.y.push_back(point.y);
    };
    for (const ChartSeries& series : chart.series) {
        std::for_each(series.points.begin(), series.points.end(), add);
        for (const double x : series.failures) {
            if (is_drawable({x, 1}, chart)) values.failed.push_back(x);
        }
    }
    std::for_each(chart.front.begin(), chart.front.end(), add);
    for (const ChartRule& rule : chart.rules) {
        if (is_drawable({1, rule.y}, chart)) values.y.push_back(rule.y);
    }
    values.x.insert(values.x.end(), values.failed.begin(), values.failed.end());
    return values;
}

/// For each failure, by rising x, the row that keeps it apart from those before it.
std::vector<int> rows_of(const std::vector<double>& sorted, const ChartAxis& x) {
    std::vector<int> rows;
    std::vector<double> ends;
    for (const double value : sorted) {
        const double at = kPlotWidth * x.share(value);
        auto row =
            std::find_if(ends.begin(), ends.end(), [at](double end) { return at - end >= kCross; });
        if (row == ends.end() && ends.size() == kMostRows) --row;
        if (row == ends.end()) row = ends.insert(ends.end(), at);
        *row = at;
        rows.push_back(static_cast<int>(row - ends.begin()));
    }
    return rows;
}

/// Lifts the top by a band, and gives each failure its place there.
void place_failures(ChartStage& stage, const Chart& chart, std::vector<double> failed) {
    stage.top = stage.y.high;
    stage.failures.resize(chart.series.size());
    if (failed.empty()) return;
    std::sort(failed.begin(), failed.end());
    const std::vector<int> rows = rows_of(failed, stage.x);
    const double band = 2 * kGap + kRowStep * *std::max_element(rows.begin(), rows.end());
    const double whole = kPlotHeight / (kPlotHeight - band);  // of the axis, with the band
    stage.top = stage.y.at(whole);
    std::vector<char> taken(failed.size(), 0);
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        for (const double x : chart.series[i].failures) {
            if (!is_drawable({x, 1}, chart)) continue;
            std::size_t k = static_cast<std::size_t>(
                std::lower_bound(failed.begin(), failed.end(), x) - failed.begin());
            while (taken[k]) ++k;  // equal costs stand beside each other
            taken[k] = 1;
            const double below = (kGap + kRowStep * rows[k]) / kPlotHeight;
            stage.failures[i].push_back({x, stage.y.at(whole * (1 - below))});
        }
    }
}

}  // namespace

bool ChartAxis::takes(double value) const { return std::isfinite(value) && (!log || value > 0); }

double ChartAxis::share(double value) const {
    return log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

double ChartAxis::at(double share) const {
    return log ? low * std::pow(high / low, share) : low + share * (high - low);
}

bool is_drawable(const ChartPoint& point, const Chart& chart) {
    return ChartAxis{chart.log_x}.takes(point.x) && ChartAxis{chart.log_y}.takes(point.y);
}

ChartStage chart_stage(const Chart& chart) {
    Values values = drawn_values(chart);
    // Stairs go from one edge to the other; marks need room.
    const bool stairs = std::all_of(chart.series.begin(), chart.series.end(),
                                    [](const ChartSeries& series) { return series.stairs; });
    ChartStage stage;
    stage.x = axis_about(values.x, chart.log_x, stairs ? 1 : 1.35);
    stage.y = axis_about(values.y, chart.log_y, 1.8);
    place_failures(stage, chart, std::move(values.failed));
    return stage;
}

}  // namespace plumb
