// SPDX-License-Identifier: MIT
/// Which plugins must not share a process, and which have been used in this one.
#pragma once

#include <plumb/plugin.h>

#include <string>

namespace plumb {

/// Whether one of two plugins names the other in its `conflicts`.
bool conflicting(const PluginTable& x, const PluginTable& y);

/// Name of a plugin used before with which this one must not share a process, by the table of
/// either; "" where there is none.
std::string conflict_of(const PluginTable& table);

/// Notes that a plugin has made a collider. The table must stay until the process ends.
void note_use(const PluginTable& table);

}  // namespace plumb
