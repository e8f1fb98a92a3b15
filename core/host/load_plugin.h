// SPDX-License-Identifier: MIT
/// One plugin file: opened, its table read and checked. Whatever is wrong with it becomes a
/// sentence.
#pragma once

#include <plumb/plugin.h>

#include <filesystem>
#include <string>

namespace plumb {

/// One plugin file: its table, or the reason why it cannot be used.
struct ColliderInfo {
    std::filesystem::path file;
    const PluginTable* table = nullptr;  ///< nullptr when refused
    std::string name;                    ///< of the table, or of the file
    std::string refusal;                 ///< a sentence; empty when usable
};

/// "ode" of "plumb_collider_ode.so".
std::string plugin_name_of(const std::filesystem::path& file);

/// Whether a file is named as plugins are.
bool is_plugin_file(const std::filesystem::path& file);

/// Loads a file with RTLD_NOW | RTLD_LOCAL and checks its table. A refused file is unloaded; one
/// that is usable stays loaded until the process ends.
ColliderInfo load_plugin(const std::filesystem::path& file);

}  // namespace plumb
