// SPDX-License-Identifier: MIT
/// The plugins under test, loaded as the host loads them.
///
/// No back-end is linked here: its global symbols would take the place of the plugin's own.
#pragma once

#include <plumb/plugin.h>

#include <string>
#include <vector>

namespace plumb::test {

/// The file behind a plugin's name, or the file itself where a path is given: looked for in
/// PLUMB_PLUGIN_PATH, then in lib/plumb/plugins beside the program. Empty where there is none.
std::string plugin_file(const std::string& name_or_file);

/// Why a plugin cannot be used, as a sentence of the host; "" where it can. The first call loads
/// it.
std::string refusal(const std::string& name_or_file);

/// The table of a plugin, loaded once a process with RTLD_NOW | RTLD_LOCAL. Ends the process with a
/// sentence where it cannot be used.
const PluginTable& plugin(const std::string& name_or_file);

/// The plugins that the tests run on: those chosen, else all that were built with this program.
std::vector<std::string> plugin_names();
void choose_plugins(const std::vector<std::string>& names_or_files);

/// What a plugin can do with two kinds.
std::uint32_t ability(const std::string& name, ShapeKind a, ShapeKind b);

/// Whether a plugin takes a shape of this kind at all: it claims some pair with it.
bool takes(const std::string& name, ShapeKind kind);

/// Notes that a plugin is going to be used in this process. Answers the name of one used before
/// that must not share a process with it, by what their tables say; else "", and then it may be.
std::string note_use(const std::string& name);

/// Accuracy of a plugin, by the precision that its table declares, relative to a shape's size.
double relative_accuracy(const std::string& name);

}  // namespace plumb::test
