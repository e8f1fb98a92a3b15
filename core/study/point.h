// SPDX-License-Identifier: MIT
/// One setting of a sweep, and what came of it.
#pragma once

#include "study/subject.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::study {

/// What is made finer along a curve.
enum class Ladder : std::uint32_t {
    substeps,    ///< substeps of one iteration each
    iterations,  ///< of both passes, in one substep
    step,        ///< dt, at the subject's own substeps and iterations
    accuracy     ///< Settings::accuracy, at the subject's own
};
std::string_view name_of(Ladder ladder);

/// Whether a smaller value is the finer one.
inline bool falls(Ladder ladder) { return ladder == Ladder::step || ladder == Ladder::accuracy; }

/// The curve of runs with Settings::leapfrog_start.
inline constexpr std::string_view kLeapfrogCurve = "leapfrog start";

/// The curve of runs in which all islands are iterated.
inline constexpr std::string_view kIteratedCurve = "without exact islands";

/// One run of a subject at certain settings.
struct Point {
    std::string subject;
    std::string curve;      ///< "pbd", "paper", "without warm start", …
    std::string precision;  ///< "single", "double"
    Ladder ladder = Ladder::substeps;
    double value = 1;  ///< substeps, iterations, dt [s], or an accuracy
    std::string collider;
    std::string contacts;               ///< "shared", "raw"
    std::vector<std::string> settings;  ///< key=value, applied to the subject's own in this order

    /// Names the point among all of a study.
    std::string key() const;
    /// The settings as one text, to be read by a person or pasted behind --set.
    std::string settings_text() const;
};

enum class Status : std::uint32_t {
    done,
    diverged,  ///< the state ran off, or its error is no number
    refused,   ///< the scene or the collider does not do this
    not_run    ///< time was up
};
std::string_view name_of(Status status);

/// CPU time of one run [µs per simulated second].
struct Cost {
    double total = 0;
    double solver = 0;  ///< all but the collider's calls
};

struct Row {
    Point point;
    Status status = Status::not_run;
    std::string note;            ///< why it is not done
    std::vector<double> errors;  ///< [metric of the subject]
    std::vector<Cost> costs;     ///< [repeated run], in the order in which they were made

    double error() const { return errors.empty() ? 0 : errors.front(); }
    Cost median_cost() const;
};

/// What a table must know of a subject once its scene is gone.
struct SubjectSummary {
    std::string name, title, reference;
    struct MetricSummary {
        std::string name, unit, what;
    };
    std::vector<MetricSummary> metrics;
    double tolerance = 0;
    Orders orders;
    double horizon = 0;          ///< until when poses are compared [s]; 0: all along
    double reference_error = 0;  ///< of the reference itself, in the first metric; 0: exact
    std::uint32_t reference_substeps = 0;  ///< Subject::reference_substeps
    std::string fingerprint;               ///< Subject::fingerprint
};
SubjectSummary summary_of(const Subject& subject);

/// What computed the costs.
struct Machine {
    std::string cpu, flags, version;
};
Machine this_machine();

/// A study: every point of the plan has its row, in the plan's order.
struct StudyTable {
    std::vector<SubjectSummary> subjects;
    std::vector<Row> rows;
    Machine machine;

    const SubjectSummary* find(std::string_view subject) const;
};

}  // namespace plumb::study
