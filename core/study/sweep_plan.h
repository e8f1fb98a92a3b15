// SPDX-License-Identifier: MIT
/// Which settings of a subject are worth a run: methods, precisions, colliders and what each
/// departure from the paper buys, made finer step by step.
#pragma once

#include "host/collider_library.h"
#include "study/point.h"

#include <string>
#include <vector>

namespace plumb::study {

/// What of the plan a person asked for; empty lists: all.
struct SweepChoice {
    std::vector<std::string> colliders;  ///< names; the first is the one that most curves run on
    std::vector<std::string> curves;     ///< names of curves
};

/// Names of the curves that there may be.
std::vector<std::string> curve_names();

/// The points of a subject. Only what its scene calls for is varied: no collider where nothing
/// touches, no gyroscopic integrator where nothing spins askew. Throws SceneError or ColliderError
/// for a subject that cannot run at all.
std::vector<Point> points_of(const Subject& subject, const SweepChoice& choice,
                             const ColliderLibrary& colliders);

/// The cheapest collider that can do a scene, then the others that can and may share a process with
/// it. Throws ColliderError where there is none.
std::vector<std::string> able_colliders(const Scene& scene, const ColliderLibrary& colliders);

/// A subject's settings with a point's applied. Throws SceneError.
Settings settings_at(const Subject& subject, const Point& point);

/// The shortest text that reads back as the same number.
std::string number_text(double value);

/// Rough measure of how long a point takes, against others of its subject: sweeps over
/// bodies and particles.
double work_of(const Subject& subject, const Settings& settings);

}  // namespace plumb::study
