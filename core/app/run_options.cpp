// SPDX-License-Identifier: MIT
#include "app/run_options.h"

#include "app/plugin_path.h"
#include "app/usage.h"
#include "reader/reader.h"
#include "scene/error.h"

#include <algorithm>
#include <array>

namespace plumb::app {
namespace {

/// An option that stands for a key of a scene's settings. Its value is kept as text, so that the
/// reader's own checks and sentences hold for it and no digit is lost.
struct SettingOption {
    const char* name;
    const char* key;
    const char* type;
    const char* description;
};

constexpr std::array kSettingOptions{
    SettingOption{"--preset", "preset", "NAME",
                  "paper = the paper's step to the letter; other options then change it"},
    SettingOption{"--method", "method", "NAME", "how a step is made: pbd"},
    SettingOption{"--precision", "precision", "NAME",
                  "single or double, of the solver's iterations"},
    SettingOption{"--duration", "duration", "SECONDS", "simulated time"},
    SettingOption{"--dt", "dt", "SECONDS", "length of a step"},
    SettingOption{"--substeps", "substeps", "N", "small steps to one detection"},
    SettingOption{"--velocity-iterations", "velocity_iterations", "N",
                  "iterations over the velocity constraints a substep"},
    SettingOption{"--position-iterations", "position_iterations", "N",
                  "iterations over the position constraints a substep"},
    SettingOption{"--threads", "threads", "N", "workers of the solver"},
    SettingOption{"--lanes", "lanes", "N",
                  "constraints side by side: 1, 4, 8, 16; 0 = as the scene calls for"},
};

/// Applies one value; `said` is how the user wrote it.
void apply(Settings& settings, const std::string& key, const std::string& value,
           const std::string& said) {
    try {
        apply_setting(settings, key + "=" + value);
    } catch (const SceneError& e) {
        std::string sentence = e.what();
        for (const std::string& part : {e.file(), "/" + key})
            if (sentence.rfind(part + ": ", 0) == 0) sentence.erase(0, part.size() + 2);
        throw UsageError(said + ": " + sentence);
    }
}

}  // namespace

void add_scene_options(CLI::App& command, RunOptions& o) {
    add_scene_options_but_collider(command, o);
    command
        .add_option("--collider", o.collider,
                    "collision plugin; auto = the cheapest that can do the scene")
        ->type_name("NAME");
}

void add_scene_options_but_collider(CLI::App& command, RunOptions& o) {
    command.add_option("scene", o.scene, "the scene's file, or a robot's .urdf")
        ->required()
        ->type_name("FILE");
    add_plugin_path_option(command, o.plugin_path);
    for (const SettingOption& s : kSettingOptions)
        command
            .add_option_function<std::string>(
                s.name, [&o, &s](const std::string& text) { o.values.emplace_back(s.key, text); },
                s.description)
            ->type_name(s.type);
    command.add_option("--set", o.settings, "one of the scene's settings; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

Scene load_scene(const RunOptions& o) {
    Scene scene = read_scene(o.scene);
    for (const SettingOption& s : kSettingOptions)
        for (const auto& [key, value] : o.values)
            if (key == s.key) apply(scene.settings, key, value, std::string(s.name) + " " + value);
    for (const std::string& setting : o.settings) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos)
            throw UsageError("--set " + setting + ": has no \"=\"; write key=value");
        apply(scene.settings, setting.substr(0, equals), setting.substr(equals + 1),
              "--set " + setting);
    }
    return scene;
}

std::unique_ptr<Simulation> start(const Scene& scene, const ColliderLibrary& colliders,
                                  const RunOptions& options) {
    try {
        return std::make_unique<Simulation>(scene, colliders, options.collider);
    } catch (const SceneError& e) {
        throw SceneError(options.scene, "", e.what());
    }
}

}  // namespace plumb::app
