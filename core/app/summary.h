// SPDX-License-Identifier: MIT
/// The numbers that describe a run, as JSON.
#pragma once

#include "app/statistics.h"
#include "host/simulation.h"
#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace plumb::app {

nlohmann::ordered_json summary(const std::string& scene_file, const Scene& scene,
                               const Simulation& simulation, const Statistics& statistics);

/// Effects with their reasons and their cost [ms a step, median].
nlohmann::ordered_json effects_summary(const Simulation& simulation, const Statistics& statistics);

}  // namespace plumb::app
