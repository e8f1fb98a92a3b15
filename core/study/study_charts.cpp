// SPDX-License-Identifier: MIT
#include "study/study_charts.h"

#include "study/findings.h"

#include <algorithm>
#include <cstdio>

namespace plumb::study {
namespace {

bool refines(const CurveRows& c) {
    return c.curve == "pbd" || c.curve == "paper" || c.curve == kLeapfrogCurve;
}

/// Whether it shows what islands that are solved until they are right buy over iterations alone.
bool solves_islands(const CurveRows& c) {
    return (c.curve == "pbd" || c.curve == kIteratedCurve) && c.precision == "single" &&
           c.ladder != Ladder::step;
}

/// What a line of a chart is called where the others differ from it in these alone.
std::string refinement(const CurveRows& c) {
    return c.curve + ", " + std::string(name_of(c.ladder)) + ", " + c.precision;
}
std::string departure(const CurveRows& c) { return c.curve == "pbd" ? "all as it is" : c.curve; }
std::string way_of_solving(const CurveRows& c) {
    return (c.curve == "pbd" ? "exact islands, by " : "iterations alone, by ") +
           std::string(name_of(c.ladder));
}
std::string collider(const CurveRows& c) { return c.collider + ", " + c.contacts; }

ChartSeries series_of(const StudyTable& table, const CurveRows& curve, const std::string& name) {
    ChartSeries series;
    series.name = name;
    for (const std::size_t i : curve.rows) {
        const Row& r = table.rows[i];
        if (r.costs.empty()) continue;
        const double x = r.median_cost().total;
        if (r.status == Status::done)
            series.points.push_back({x, r.error()});
        else
            series.failures.push_back(x);
    }
    return series;
}

std::string caption_of(const Machine& m) {
    return m.cpu + ", " + m.flags + ", plumb " + m.version + "; medians of repeated runs";
}

/// A chart without lines.
Chart empty_chart(const StudyTable& table, const SubjectSummary& s) {
    const auto& metric = s.metrics.front();
    Chart chart;
    chart.title = s.title;
    chart.x_label = "CPU time [µs per simulated second]";
    chart.y_label = metric.what + (metric.unit.empty() ? "" : " [" + metric.unit + "]");
    chart.caption = caption_of(table.machine);
    if (s.tolerance > 0) {
        char name[64];
        std::snprintf(name, sizeof name, "tolerance %g %s", s.tolerance, metric.unit.c_str());
        chart.rules.push_back({name, s.tolerance});
    }
    if (s.reference_error > 0) {
        char name[64];
        std::snprintf(name, sizeof name, "error of the reference, %.2g %s", s.reference_error,
                      metric.unit.c_str());
        chart.rules.push_back({name, s.reference_error});
    }
    return chart;
}

std::vector<ChartPoint> front_points(const StudyTable& table, const std::vector<bool>& front,
                                     const std::string& subject) {
    std::vector<ChartPoint> points;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (front[i] && table.rows[i].point.subject == subject)
            points.push_back({table.rows[i].median_cost().total, table.rows[i].error()});
    std::sort(points.begin(), points.end(),
              [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
    return points;
}

}  // namespace

std::vector<NamedChart> charts_of(const StudyTable& table) {
    const std::vector<CurveRows> curves = curves_of(table);
    const std::vector<bool> front = front_of(table);
    std::vector<NamedChart> charts;
    for (const SubjectSummary& s : table.subjects) {
        const auto add = [&](const std::string& ending, auto&& belongs, auto&& name) {
            NamedChart c{s.name + ending, empty_chart(table, s)};
            for (const CurveRows& curve : curves) {
                if (curve.subject != s.name || !belongs(curve)) continue;
                ChartSeries series = series_of(table, curve, name(curve));
                if (!series.points.empty() || !series.failures.empty())
                    c.chart.series.push_back(std::move(series));
            }
            if (ending.empty()) c.chart.front = front_points(table, front, s.name);
            if (c.chart.series.size() > 1) charts.push_back(std::move(c));
        };
        std::string first;  // the collider that most curves run on
        for (const CurveRows& c : curves)
            if (c.subject == s.name && first.empty()) first = c.collider;
        const auto plain = [](const CurveRows& c) {
            return c.ladder == Ladder::substeps && c.precision == "single";
        };
        add(
            "", [&](const CurveRows& c) { return refines(c) && c.collider == first; }, refinement);
        add(
            "-departures",
            [&](const CurveRows& c) {
                return plain(c) && c.collider == first && c.contacts == "shared" &&
                       c.curve != "paper";
            },
            departure);
        const auto is_iterated = [&](const CurveRows& c) {
            return c.subject == s.name && c.curve == kIteratedCurve;
        };
        if (std::any_of(curves.begin(), curves.end(), is_iterated))
            add(
                "-islands",
                [&](const CurveRows& c) { return solves_islands(c) && c.collider == first; },
                way_of_solving);
        add(
            "-colliders",
            [&](const CurveRows& c) {
                return plain(c) && (c.curve == "pbd" || c.contacts == "raw");
            },
            collider);
    }
    NamedChart profile{"profile", {}};
    profile.chart.title = "Subjects solved to their tolerance";
    profile.chart.x_label = "cost, over the cheapest of all";
    profile.chart.y_label = "share of the subjects";
    profile.chart.log_y = false;
    profile.chart.caption = caption_of(table.machine);
    for (const Profile& p : profiles_of(table)) {
        ChartSeries series;
        series.name = p.name;
        series.stairs = true;
        for (const auto& [ratio, share] : p.points) series.points.push_back({ratio, share});
        profile.chart.series.push_back(std::move(series));
    }
    if (table.subjects.size() > 1 && profile.chart.series.size() > 1)
        charts.push_back(std::move(profile));
    return charts;
}

}  // namespace plumb::study
