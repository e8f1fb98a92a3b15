// SPDX-License-Identifier: MIT
/// A subject of any scene: it is measured against runs of itself that are far finer.
///
/// Two references are made, one twice as fine as the other. How far they part tells the error of
/// the references themselves; when they part by more than a hundredth of a body, prediction ends:
/// poses are compared until then, and means over time (energy, height) all along.
#pragma once

#include "host/collider_library.h"
#include "study/run_point.h"
#include "study/subject.h"

#include <string>

namespace plumb::study {

struct ReferenceOptions {
    std::string collider = "auto";
    double seconds = 60;  ///< that making the references may take
    Stop stop;            ///< asked between steps
};

/// Throws SceneError or ColliderError for what cannot run, and std::runtime_error where even the
/// finest run that the time allows goes astray, or `stop` ended it.
Subject self_referenced(const Scene& scene, const std::string& name,
                        const ColliderLibrary& colliders, const ReferenceOptions& options);

}  // namespace plumb::study
