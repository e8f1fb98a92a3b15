// SPDX-License-Identifier: MIT
/// Runs of subjects, and how far they were off.
#pragma once

#include "study/cases.h"
#include "support/scenes.h"

#include <ostream>
#include <vector>

namespace plumb::study {

inline void PrintTo(const CaseEntry& entry, std::ostream* out) { *out << entry.name; }

}  // namespace plumb::study

namespace plumb::test {

/// Errors of one run, one a metric; infinite ones where it diverged.
inline std::vector<double> errors_of(const study::Subject& subject,
                                     const std::string& collider = "auto") {
    Simulation simulation(subject.scene, colliders(), collider);
    std::vector<std::unique_ptr<study::Judge>> judges;
    for (const study::Metric& metric : subject.metrics) judges.push_back(metric.judge());
    const auto look = [&] {
        for (const auto& judge : judges) judge->look(simulation.world());
    };
    look();
    const auto steps = std::llround(subject.scene.settings.duration / subject.scene.settings.dt);
    for (long long i = 0; i < steps; ++i) {
        const StepReport report = simulation.step();
        if (!report.finite) return std::vector(judges.size(), HUGE_VAL);
        EXPECT_FALSE(report.collider_failed) << report.message;
        look();
    }
    std::vector<double> errors;
    for (const auto& judge : judges) errors.push_back(judge->error());
    return errors;
}

}  // namespace plumb::test
