// SPDX-License-Identifier: MIT
/// The option that says where collision plugins are looked for first.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace plumb::app {

/// Adds --plugin-path to a verb. What it names must be directories: a slip would otherwise leave
/// its plugins out without a word.
void add_plugin_path_option(CLI::App& command, std::string& path);

}  // namespace plumb::app
