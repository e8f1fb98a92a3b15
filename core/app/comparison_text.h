// SPDX-License-Identifier: MIT
/// A comparison on stdout, to be read in a terminal.
#pragma once

#include "study/comparison.h"
#include "study/free_run.h"

#include <string>

namespace plumb::app {

/// `runs` may be nullptr.
std::string comparison_text(const Scene& scene, const study::ComparisonResult& result,
                            const study::FreeRuns* runs);

}  // namespace plumb::app
