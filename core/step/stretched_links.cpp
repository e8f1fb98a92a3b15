// SPDX-License-Identifier: MIT
#include "step/stages.h"
#include "world/link_error.h"

#include <algorithm>

namespace plumb {
namespace {

/// Share of a link's length, or of the radius of a particle that is attached, from which on it
/// counts as stretched: what it holds is being let go.
constexpr double kStretched = 0.01, kApart = 0.1;

double stretched_from(const World& world, const Link& link) {
    if (!link.joins) return kStretched * link.longest;
    double radius = 0;
    for (const WorldPoint* p : {&link.a, &link.b})
        if (p->particle != kNoIndex) radius = std::max(radius, world.particles.radius[p->particle]);
    return kApart * radius;
}

}  // namespace

void note_stretched_links(const World& world, StepReport& report) {
    for (const Link& link : world.links) {
        const double error = link_error(world, link);
        if (!(error > stretched_from(world, link))) continue;
        ++report.stretched_links;
        report.link_error = std::max(report.link_error, error);
    }
}

}  // namespace plumb
