// SPDX-License-Identifier: MIT
/// The files that a study leaves in its folder.
#pragma once

#include "study/point.h"

#include <string>
#include <vector>

namespace plumb::app {

/// Writes points.csv, findings.json, report.html and the folder charts/. Returns
/// what could not be made, in sentences. Throws OutputError.
std::vector<std::string> write_study(const study::StudyTable& table, const std::string& folder);

}  // namespace plumb::app
