// SPDX-License-Identifier: MIT
/// Errors that need no reference: what a world shows of itself.
#pragma once

#include "effects/plan.h"
#include "study/subject.h"

#include <vector>

namespace plumb::study {

/// Those that a scene calls for: of joints where there are any, of contacts where bodies touch, of
/// volumes where balloons keep one.
///
///   penetration      depth, mean over the pairs that penetrate and over time [m]
///   joints           how far a joint's points parted, at most [m]
///   complementarity  gap at which contacts push, weighted by how hard, mean over time [m]
///   cone             friction beyond its bound, over all that pushes, mean over time
///   volume           V / k V₀ − 1 of the balloon that is off the most, mean over time
std::vector<Metric> gauges_of(const Plan& plan, const World& world);

/// Depth, mean over the pairs that penetrate [m]; 0 where none does.
double mean_penetration(const World& world);

}  // namespace plumb::study
