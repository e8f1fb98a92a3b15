// SPDX-License-Identifier: MIT
/// Runs the points of subjects and makes a table of what accuracy costs.
///
///     StudyTable table = plan_sweep({self_referenced(scene, …)}, {}, colliders);
///     sweep(table, subjects, colliders, {.budget = 60});
#pragma once

#include "host/collider_library.h"
#include "study/point.h"
#include "study/run_point.h"
#include "study/sweep_plan.h"

#include <cstddef>
#include <functional>
#include <limits>

namespace plumb::study {

/// How far a sweep has come, told before each run.
struct SweepProgress {
    std::size_t done, all;  ///< runs; `all` is the most that there may be
    const Row* next;
};

struct SweepOptions {
    double budget = std::numeric_limits<double>::infinity();  ///< time for all runs [s]
    std::uint32_t repeats = 5;        ///< runs of each point whose times are taken, at most
    std::uint32_t shard = 1, of = 1;  ///< run only every `of`-th point, beginning with `shard`

    /// Told of each run that ended.
    std::function<void(std::size_t row, bool judged, const Outcome&)> ran;
    std::function<void(const SweepProgress&)> progress;
    Stop interrupted;  ///< asked between steps
};

/// The table of a sweep before anything ran. Throws std::invalid_argument where two subjects have
/// one name, and what points_of throws.
StudyTable plan_sweep(const std::vector<Subject>& subjects, const SweepChoice& choice,
                      const ColliderLibrary& colliders);

/// Runs what the table lacks: every point once for its errors, the quick ones first, as far as the
/// budget reaches; then all again in turn for their times, so that what disturbs the machine for a
/// while disturbs all of them. Rows that were not run say so. Returns whether it came to its end
/// without an interrupt.
bool sweep(StudyTable& table, const std::vector<Subject>& subjects,
           const ColliderLibrary& colliders, const SweepOptions& options);

}  // namespace plumb::study
