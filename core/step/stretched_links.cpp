// SPDX-License-Identifier: MIT
#include "step/stages.h"
#include "world/link_error.h"

namespace plumb {
namespace {

/// Share of a link's length from which on it counts as stretched: what it holds is being let go.
constexpr double kStretched = 0.01;

}  // namespace

void note_stretched_links(const World& world, StepReport& report) {
    for (const Link& link : world.links) {
        const double error = link_error(world, link);
        if (!(error > kStretched * link.longest)) continue;
        ++report.stretched_links;
        report.link_error = std::max(report.link_error, error);
    }
}

}  // namespace plumb
