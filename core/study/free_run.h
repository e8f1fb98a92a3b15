// SPDX-License-Identifier: MIT
/// A run of the scene by each collider of a comparison, and how the runs drift apart.
///
/// Contacts that agree to the last digits still part in the end: a pile is chaotic. What should
/// stay alike are heights and energies.
#pragma once

#include "study/comparison.h"

namespace plumb::study {

/// Two runs against each other, [sample]: distances between the same moving bodies and deformables
/// (study/trajectory.h) [m].
struct Drift {
    std::size_t first, second;  ///< indices into the colliders
    std::vector<double> mean, largest;
};

struct FreeRuns {
    std::vector<double> times;                        ///< [sample], [s]
    std::vector<std::vector<double>> height, energy;  ///< [collider][sample], [m], [J]
    std::vector<Drift> drifts;                        ///< every two colliders
    bool was_interrupted = false;
    /// [collider], the step that left no finite state; 0: none. The first one ends all runs.
    std::vector<std::uint64_t> diverged_after;
};

/// Told of each step and the contacts of the last run; where it says false, all runs end there.
using FreeRunWatch = std::function<bool(std::uint64_t step, std::uint32_t contacts)>;

/// `watch` may be empty. `sources`: of colliders in processes of their own, asked through them; the
/// others run as plugins of this process. Throws ColliderError when a collider goes on failing.
FreeRuns free_runs(const Scene& scene, const ColliderLibrary& colliders,
                   const std::vector<std::unique_ptr<ContactSource>>& sources,
                   const std::vector<bool>& own_process, const FreeRunWatch& watch = {});

}  // namespace plumb::study
