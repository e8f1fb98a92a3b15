// SPDX-License-Identifier: MIT
/// The cheapest settings that reach an error, found with few runs. What the reference itself may be
/// off counts as error of each run.
///
/// The error of a run falls as a power of the substeps. Two runs give the power, the next go where
/// it foretells the wanted error; then what does the same work in another way is tried: double
/// precision where single stops, raw contacts and other colliders where detection costs much, fewer
/// detections or more, the other way of solving joints, a single substep with many iterations. The
/// best is run once more to verify it.
#pragma once

#include "host/collider_library.h"
#include "study/run_point.h"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plumb::study {

struct TuneOptions {
    double error = 0;  ///< wanted, in the unit of the subject's first metric; 0: the least within
                       ///< `time`
    double time = std::numeric_limits<double>::infinity();  ///< CPU allowed [µs/s]
    std::string collider = "auto";  ///< one by name, or any that can do the scene
    double detections = 0.25;       ///< share of the time that they must take, for raw contacts and
                                    ///< other colliders to be tried
    std::uint32_t most_runs = 15;
    double seconds = std::numeric_limits<double>::infinity();  ///< for all runs but the last [s]
    Stop stop;
    std::function<void(std::uint32_t run, std::uint32_t most, const Point&)> progress;
};

/// A run that was made on the way.
struct Trial {
    Point point;
    Outcome outcome;

    bool is_done() const { return outcome.status == Status::done; }
    double error() const {
        return is_done() ? outcome.errors.front() : std::numeric_limits<double>::infinity();
    }
};

struct TuneResult {
    std::optional<Trial> best;  ///< with the outcome of the run that verified it; none: not reached
    std::vector<Trial> trials;  ///< in the order in which they were made
    bool ran_out = false;       ///< whether TuneOptions::seconds were over before all was tried
};

TuneResult tune(const Subject& subject, const ColliderLibrary& colliders,
                const TuneOptions& options);

}  // namespace plumb::study
