// SPDX-License-Identifier: MIT
/// What each effect of a scene costs, and what goes wrong without it: the scene is run with and
/// without it from the same start, a step of one after a step of the other.
#pragma once

#include "app/run_options.h"
#include "host/simulation.h"

#include <cstdint>
#include <string>
#include <vector>

namespace plumb::app {

struct AblationPlan {
    std::uint64_t steps = 50;  ///< of each run
    std::uint32_t repeats = 3;
};

/// One effect that runs. Times are medians over the steps of all repeats; errors are those at the
/// end of a run, which are alike in every repeat.
struct AblatedEffect {
    std::string name;
    bool timed = false;     ///< whether the times are known
    bool compared = false;  ///< whether both runs came to their end, so that there are errors
    double with_ms = 0, without_ms = 0;  ///< a step
    double error = 0;  ///< largest distance between the places of a body, or of a deformable's
                       ///< particles (rms, by mass), in both runs [m]
    double energy_change = 0;  ///< energy without it less energy with it [J]
    std::string trouble;       ///< why there are no figures, or no errors; empty: all is well

    double cost_ms() const { return with_ms - without_ms; }
};

/// Every effect that runs in `simulation`, which stays as it is. Stops early on an interrupt.
std::vector<AblatedEffect> ablate(const Scene& scene, const ColliderLibrary& colliders,
                                  const RunOptions& options, const Simulation& simulation,
                                  const AblationPlan& plan);

}  // namespace plumb::app
