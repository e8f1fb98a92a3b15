// SPDX-License-Identifier: MIT
/// A comparison on stdout, to be read in a terminal.
#pragma once

#include "app/comparison.h"
#include "app/free_run.h"

#include <string>

namespace plumb::app {

/// `runs` may be nullptr.
std::string comparison_text(const Scene& scene, const ComparisonResult& result,
                            const FreeRuns* runs);

}  // namespace plumb::app
