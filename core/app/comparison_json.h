// SPDX-License-Identifier: MIT
/// A comparison as data: what --json writes and the page reads.
#pragma once

#include "study/comparison.h"
#include "study/free_run.h"

#include <nlohmann/json.hpp>

namespace plumb::app {

/// `bodies`: of a world of the scene, for where shapes sit in their bodies.
nlohmann::ordered_json comparison_json(const Scene& scene, const Bodies& bodies,
                                       const study::ComparisonResult& result);

/// How free runs drift apart; the colliders are those of `result`.
nlohmann::ordered_json free_runs_json(const study::ComparisonResult& result,
                                      const study::FreeRuns& runs);

}  // namespace plumb::app
