// SPDX-License-Identifier: MIT
/// What the command line says about how a scene is to be run.
#pragma once

#include "host/simulation.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace plumb::app {

struct RunOptions {
    std::string scene;
    std::string collider = "auto";
    std::string plugin_path;
    std::vector<std::pair<std::string, std::string>> values;  ///< key of the settings, text
    std::vector<std::string> settings;                        ///< key=value
};

/// Options that every verb has that loads a scene.
void add_scene_options(CLI::App& command, RunOptions& options);

/// The same for a verb that takes several colliders.
void add_scene_options_but_collider(CLI::App& command, RunOptions& options);

/// Reads the scene and applies the command line to its settings. Throws SceneError, or UsageError
/// for what the command line says.
Scene load_scene(const RunOptions& options);

/// Makes the simulation; what its world or plan refuses names the scene's file.
std::unique_ptr<Simulation> start(const Scene& scene, const ColliderLibrary& colliders,
                                  const RunOptions& options);

}  // namespace plumb::app
