// SPDX-License-Identifier: MIT
/// Runs gnuplot, where there is one.
#pragma once

#include <string>

namespace plumb {

/// Runs a script by its name in the folder where it stands, without a shell. What comes back is ""
/// when all went well, and else a sentence that says what did not.
std::string run_gnuplot(const std::string& program, const std::string& folder,
                        const std::string& script);

}  // namespace plumb
