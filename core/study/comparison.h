// SPDX-License-Identifier: MIT
/// Several colliders asked about the same poses, and what came of it.
///
/// One collider, the driver, steps the scene; before each step that is looked at all are asked
/// which contacts there are, once for their full answer (clipped) and once for what their
/// back-ends themselves say (raw). Every two of them are then measured against each other.
#pragma once

#include "host/contact_source.h"
#include "host/simulation.h"
#include "measure/contact_comparison.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plumb::study {

/// What a collider answered, clipped or raw, over all poses.
struct AnswerFigures {
    std::vector<double> milliseconds;  ///< [pose], inside the collider's call
    DetectStats sum{};                 ///< of all poses
    std::uint64_t contacts = 0, rejected = 0;
    std::uint64_t failures = 0;  ///< poses at which the collider failed on a part
    std::string first_failure;
};

struct ColliderFigures {
    SourceInfo info;
    bool own_process = false;
    AnswerFigures clipped, raw;
};

/// Two colliders against each other.
struct PairFigures {
    std::size_t first, second;  ///< indices into ComparisonResult::colliders
    ContactComparison clipped, raw;
};

struct ComparisonResult {
    std::vector<ColliderFigures> colliders;
    std::vector<PairFigures> pairs;
    std::size_t driver = 0;
    std::uint64_t poses = 0;  ///< moments that all were asked about
    std::uint64_t steps = 0;
    double time = 0;  ///< simulated [s]
    bool was_interrupted = false;
    bool raw_judged = false;  ///< whether what the back-ends themselves say must agree, too
    std::uint64_t diverged_after = 0;  ///< step that left no finite state, and ended it; 0: none

    /// Whether a collider gave its whole clipped answer at every pose.
    bool answered(std::size_t collider) const;
    /// The sets that are judged are alike.
    bool alike(const PairFigures& pair) const;
    /// And both are whole.
    bool agrees(const PairFigures& pair) const;
    bool agrees() const;  ///< all pairs of colliders
};

/// What is to be compared.
struct ComparisonPlan {
    const Scene& scene;
    std::vector<std::unique_ptr<ContactSource>>& sources;
    std::vector<bool> own_process;  ///< [source]
    std::size_t driver;             ///< index of the source whose collider steps the scene
    std::uint64_t every;            ///< steps from one look to the next
    bool judge_raw = false;         ///< as ComparisonResult::raw_judged
};

/// Told of each step, of its contacts, and whether all agree so far; where it says false, the
/// comparison ends there, as interrupted.
using ComparisonWatch = std::function<bool(std::uint64_t step, std::uint32_t contacts, bool agree)>;

/// Runs the scene to its end, or to where `watch` (may be empty) ends it, and compares.
/// `simulation`: of the plan's scene, with the driver's collider. Throws ColliderError when a
/// collider gives no more answers.
ComparisonResult compare_colliders(const ComparisonPlan& plan, Simulation& simulation,
                                   const ComparisonWatch& watch = {});

}  // namespace plumb::study
