// SPDX-License-Identifier: MIT
#include "study/gauges.h"

#include "measure/measure.h"
#include "study/judges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumb::study {
namespace {

double mean_penetration(const World& world) {
    const std::vector<double> depths = penetrations(world);
    const double sum = std::accumulate(depths.begin(), depths.end(), 0.0);
    return depths.empty() ? 0 : sum / static_cast<double>(depths.size());
}

double widest_joint(const World& world) {
    const std::vector<double> errors = joint_errors(world);
    return errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
}

/// Contacts of the last step: `found` as they were at its start, with what they pushed in it. The
/// product gap × push is 0 of each contact that is solved exactly.
double complementarity(const World& world) {
    double product = 0, pushes = 0;
    const ContactTable& c = world.contacts;
    for (std::size_t i = 0; i < c.found.size() && i < c.memory.size(); ++i) {
        product += std::max(0.0, c.found[i].gap) * c.memory[i].normal_impulse;
        pushes += c.memory[i].normal_impulse;
    }
    return pushes > 0 ? product / pushes : 0;
}

double cone_excess(const World& world) {
    double excess = 0, pushes = 0;
    const ContactTable& c = world.contacts;
    for (std::size_t i = 0; i < c.found.size() && i < c.memory.size(); ++i) {
        const double push = c.memory[i].normal_impulse;
        const double bound = world.surface_pair(c.found[i].a, c.found[i].b).friction * push;
        excess += std::max(0.0, c.memory[i].friction_impulse.norm() - bound);
        pushes += push;
    }
    return pushes > 0 ? excess / pushes : 0;
}

}  // namespace

std::vector<Metric> gauges_of(const Plan& plan) {
    std::vector<Metric> gauges;
    if (plan.runs(Effect::contacts)) {
        gauges.push_back(mean_over_time("penetration", "m", "mean depth of pairs that penetrate",
                                        mean_penetration));
        gauges.push_back(mean_over_time("complementarity", "m", "mean gap at which contacts push",
                                        complementarity));
    }
    if (plan.runs(Effect::friction))
        gauges.push_back(
            mean_over_time("cone", "", "friction beyond its bound, over all pushes", cone_excess));
    if (plan.runs(Effect::joints))
        gauges.push_back(
            largest("joints", "m", "largest distance of a joint's points", widest_joint));
    return gauges;
}

}  // namespace plumb::study
