// SPDX-License-Identifier: MIT
#include "study/point.h"

#include <algorithm>
#include <array>
#include <fstream>

namespace plumb::study {
namespace {

/// The middle value, or the mean of the two in the middle; 0 of none.
double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace

std::string_view name_of(Ladder ladder) {
    constexpr std::array<std::string_view, 4> kNames{"substeps", "iterations", "step", "accuracy"};
    return kNames[static_cast<std::size_t>(ladder)];
}

std::string_view name_of(Status status) {
    constexpr std::array<std::string_view, 4> kNames{"done", "diverged", "refused", "not run"};
    return kNames[static_cast<std::size_t>(status)];
}

std::string Point::settings_text() const {
    std::string text;
    for (const std::string& setting : settings) text += (text.empty() ? "" : " ") + setting;
    return text;
}

std::string Point::key() const {
    return subject + "|" + curve + "|" + std::string(name_of(ladder)) + "|" + collider + "|" +
           settings_text();
}

Cost Row::median_cost() const {
    std::vector<double> total, solver;
    for (const Cost& c : costs) total.push_back(c.total), solver.push_back(c.solver);
    return {median(total), median(solver)};
}

SubjectSummary summary_of(const Subject& s) {
    SubjectSummary summary{.name = s.name,
                           .title = s.title,
                           .reference = s.reference,
                           .metrics = {},
                           .tolerance = s.tolerance,
                           .orders = s.orders,
                           .horizon = s.horizon,
                           .reference_error = s.metrics.front().reference_error,
                           .reference_substeps = s.reference_substeps,
                           .fingerprint = s.fingerprint};
    for (const Metric& m : s.metrics) summary.metrics.push_back({m.name, m.unit, m.what});
    return summary;
}

Machine this_machine() {
    Machine machine{"unknown processor", PLUMB_FLAGS, PLUMB_VERSION};
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("model name", 0) != 0) continue;
        const std::size_t colon = line.find(':');
        if (colon != std::string::npos) machine.cpu = line.substr(colon + 2);
        break;
    }
    return machine;
}

const SubjectSummary* StudyTable::find(std::string_view subject) const {
    for (const SubjectSummary& s : subjects)
        if (s.name == subject) return &s;
    return nullptr;
}

}  // namespace plumb::study
