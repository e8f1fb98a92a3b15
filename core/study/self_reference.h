// SPDX-License-Identifier: MIT
/// A subject of any scene: it is measured against runs of itself that are far finer.
///
/// References are made, each with twice the substeps of the one before and more iterations, until
/// the finest is known well enough or the time is over. How far the last three part tells the error
/// of the finest; where it is more than a share of the error that is wanted (without one, a
/// hundredth of a body), prediction ends: poses are compared until then, and means over time
/// (energy, momentum, height, strain) all along. A deformable counts as one body, however many
/// particles it has (trajectory.h).
///
/// Where poses are wanted to an error, finer references run no farther than prediction may go, and
/// the subject's scene is as long as the finest of them.
#pragma once

#include "host/collider_library.h"
#include "study/run_point.h"
#include "study/subject.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace plumb::study {

struct ReferenceOptions {
    std::string collider = "auto";
    double seconds = 60;         ///< that making the references may take, about
    std::uint32_t substeps = 0;  ///< of the finest, to a step of the scene; 0: as many as the time
                                 ///< allows, or `error` asks for
    double error = 0;  ///< of runs that will be compared; references that are known to a seventh of
                       ///< it are fine enough. 0: as fine as the time allows
    std::string metric = "";  ///< what `error` is of; "": the subject's first
    Stop stop = {};           ///< asked between steps
};

/// Why there is no reference.
struct NoReference : std::runtime_error {
    enum Reason { stopped, out_of_time, runs_off } reason;
    NoReference(Reason why, const std::string& sentence)
        : std::runtime_error(sentence), reason(why) {}
};

/// Throws SceneError or ColliderError for what cannot run, or does not run for eight steps or has
/// nothing that moves; and NoReference where the time is far too short, where even a fine run goes
/// astray, or where `stop` ended it.
Subject self_referenced(const Scene& scene, const std::string& name,
                        const ColliderLibrary& colliders, const ReferenceOptions& options);

}  // namespace plumb::study
