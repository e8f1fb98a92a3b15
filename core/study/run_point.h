// SPDX-License-Identifier: MIT
/// One run of a subject, judged and timed.
#pragma once

#include "host/collider_library.h"
#include "study/point.h"

#include <functional>

namespace plumb::study {

/// Asked between steps: whether the run shall be given up, for want of time or because a person
/// asked for it.
using Stop = std::function<bool()>;

/// What one run told. `status` is not_run where `stop` ended it.
struct Outcome {
    Status status = Status::not_run;
    std::string note;
    std::vector<double> errors;  ///< [metric]; empty unless it was judged and done
    Cost cost;
};

/// Runs the subject at a point's settings over its whole duration. `judged`: whether its errors are
/// wanted; without, the run does nothing but step. Only time within Simulation::step counts, less
/// what other processes took of it; a run of less than two milliseconds is made again for it, with
/// warm caches. What a scene or a collider refuses becomes an outcome.
Outcome run_point(const Subject& subject, const Point& point, const ColliderLibrary& colliders,
                  bool judged, const Stop& stop);

}  // namespace plumb::study
