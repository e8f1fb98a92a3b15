// SPDX-License-Identifier: MIT
/// What a simulation logs: its plan's warnings when they come up, and what went wrong in a step.
#include "host/log.h"
#include "host/simulation_parts.h"

#include <algorithm>

namespace plumb {

void Simulation::Parts::tell_warnings() {
    const std::vector<std::string>& now = stepper.plan.warnings;
    for (const std::string& warning : now)
        if (std::find(told.begin(), told.end(), warning) == told.end()) logger()->warn(warning);
    told = now;
}

void Simulation::Parts::tell_step(const StepReport& report) const {
    const auto to = logger();
    if (!to->should_log(spdlog::level::debug)) return;
    if (report.collider_failed)
        to->debug("step {}: collider \"{}\" failed: {}", world.steps, collider_name,
                  report.message);
    if (report.rejected_contacts > 0)
        to->debug("step {}: {} contacts that make no sense were left out", world.steps,
                  report.rejected_contacts);
    if (!report.finite) to->debug("step {}: the state is no longer finite", world.steps);
    if (report.torn_elements > 0)
        to->debug("step {}: {} elements were torn out", world.steps, report.torn_elements);
    if (report.unsolved_islands > 0)
        to->trace("step {}: {} islands miss the law of contact", world.steps,
                  report.unsolved_islands);
    if (report.costly_islands > 0)
        to->trace("step {}: {} islands miss the accuracy and would take too much", world.steps,
                  report.costly_islands);
    if (report.unsolved_trees > 0)
        to->trace("step {}: {} trees of joints were left open, by {:.3g} at the most", world.steps,
                  report.unsolved_trees, report.tree_error);
    if (report.coarse_trees > 0)
        to->trace("step {}: {} trees of joints snap too fast to be followed and lose energy",
                  world.steps, report.coarse_trees);
    if (report.gaping.joints > 0)
        to->trace(
            "step {}: {} joints are open or past a limit, by {:.3g} m and {:.3g} rad at the most",
            world.steps, report.gaping.joints, report.gaping.along, report.gaping.about);
    if (report.gaping.couplings > 0)
        to->trace("step {}: {} couplings have slipped, by {:.3g} m or rad at the most", world.steps,
                  report.gaping.couplings, report.gaping.coupled);
    if (report.stretched_links > 0)
        to->trace("step {}: {} links are too long or too short, by {:.3g} m at the most",
                  world.steps, report.stretched_links, report.link_error);
    if (report.clamped_recoveries > 0)
        to->trace("step {}: {} overlaps are deeper than a substep pushes out", world.steps,
                  report.clamped_recoveries);
}

}  // namespace plumb
