// SPDX-License-Identifier: MIT
#include "app/plugin_path.h"

#include <filesystem>
#include <sstream>

namespace plumb::app {
namespace {

/// What is wrong with a list separated by ':', or nothing.
std::string refusal(const std::string& list) {
    std::stringstream stream(list);
    for (std::string directory; std::getline(stream, directory, ':');) {
        std::error_code ignored;
        if (directory.empty() || std::filesystem::is_directory(directory, ignored)) continue;
        return '"' + directory +
               (std::filesystem::exists(directory, ignored)
                    ? "\" is not a directory; name the one that holds the plugin"
                    : "\": there is no such directory");
    }
    return {};
}

}  // namespace

void add_plugin_path_option(CLI::App& command, std::string& path) {
    command
        .add_option("--plugin-path", path,
                    "directories to look for plugins in first, separated by ':'")
        ->type_name("DIRS")
        ->check(refusal);
}

}  // namespace plumb::app
