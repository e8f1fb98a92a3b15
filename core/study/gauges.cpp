// SPDX-License-Identifier: MIT
#include "study/gauges.h"

#include "measure/deformation.h"
#include "measure/measure.h"
#include "study/judges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumb::study {
namespace {

double widest_joint(const World& world) {
    const std::vector<double> errors = joint_errors(world);
    return errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
}

double worst_volume(const World& world) {
    double worst = 0;
    for (const double error : volume_errors(world)) worst = std::max(worst, std::abs(error));
    return worst;
}

/// Of the last step's contacts, the sum of `figure(contact, its normal and friction impulse)` over
/// the sum of what they pushed. Gaps are those at the step's start.
template <class Figure>
double per_push(const World& world, Figure figure) {
    const ContactTable& c = world.contacts;
    double sum = 0, pushes = 0;
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        sum += figure(c.found[i], c.memory[i]);
        pushes += c.memory[i].normal_impulse;
    }
    return pushes > 0 ? sum / pushes : 0;
}

/// The product gap × push is 0 of each contact that is solved exactly.
double complementarity(const World& world) {
    return per_push(world, [](const Contact& contact, const ContactMemory& memory) {
        return std::max(0.0, contact.gap) * memory.normal_impulse;
    });
}

double cone_excess(const World& world) {
    return per_push(world, [&](const Contact& contact, const ContactMemory& memory) {
        const double friction = world.surface_pair(contact.a, contact.b).friction;
        return std::max(0.0, memory.friction_impulse.norm() - friction * memory.normal_impulse);
    });
}

}  // namespace

double mean_penetration(const World& world) {
    const std::vector<double> depths = penetrations(world);
    const double sum = std::accumulate(depths.begin(), depths.end(), 0.0);
    return depths.empty() ? 0 : sum / static_cast<double>(depths.size());
}

std::vector<Metric> gauges_of(const Plan& plan, const World& world) {
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
    if (plan.runs(Effect::deformables) && !volume_errors(world).empty())
        gauges.push_back(
            mean_over_time("volume", "", "mean error of a balloon's volume at most", worst_volume));
    return gauges;
}

}  // namespace plumb::study
