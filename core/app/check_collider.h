// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace plumb::app {

/// Runs the conformance suite on one plugin, a name or a file; `path` is searched first for names.
/// Prints a verdict; returns 0 when the plugin conforms, 1 when it does not.
int check_collider(const std::string& name_or_file, const std::string& path);

}  // namespace plumb::app
