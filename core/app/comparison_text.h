// SPDX-License-Identifier: MIT
/// A comparison on stdout, to be read in a terminal.
#pragma once

#include "app/comparison.h"

#include <string>

namespace plumb::app {

std::string comparison_text(const Scene& scene, const ComparisonResult& result);

}  // namespace plumb::app
