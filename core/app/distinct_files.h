// SPDX-License-Identifier: MIT
/// Outputs named on the command line must be files of their own, however their paths are spelt.
#pragma once

#include <string>
#include <vector>

namespace plumb::app {

/// Throws UsageError where two outputs are one file, which they would write over each other, or one
/// is what `input` reads. "" (none) and "-" (stdout) are no files.
void check_distinct(const std::vector<std::string>& files, const std::string& input);

}  // namespace plumb::app
