// SPDX-License-Identifier: MIT
/// A study and its findings as JSON text, which the report carries and other programs may read.
#pragma once

#include "study/point.h"

#include <string>

namespace plumb::study {

/// Errors are in the unit of their metric, costs in µs of CPU a simulated second.
std::string study_json(const StudyTable& table, const std::string& title);

}  // namespace plumb::study
