// SPDX-License-Identifier: MIT
#include "app/run_options.h"

#include "reader/reader.h"
#include "scene/error.h"

namespace plumb::app {

void add_scene_options(CLI::App& command, RunOptions& o) {
    command.add_option("scene", o.scene, "the scene's file")->required();
    command.add_option("--collider", o.collider,
                       "collision plugin; auto = the first that can do the scene");
    command.add_option("--plugin-path", o.plugin_path,
                       "directories to look for plugins in first, separated by ':'");
    command.add_option("--preset", o.preset, "paper = the paper's step to the letter");
    command.add_option("--method", o.method, "pbd");
    command.add_option("--precision", o.precision, "single or double, of the solver's iterations");
    command.add_option("--duration", o.duration, "simulated time [s]");
    command.add_option("--dt", o.dt, "step [s]");
    command.add_option("--substeps", o.substeps, "small steps to one detection");
    command.add_option("--velocity-iterations", o.velocity_iterations);
    command.add_option("--position-iterations", o.position_iterations);
    command.add_option("--threads", o.threads, "workers of the solver");
    command.add_option("--lanes", o.lanes,
                       "constraints side by side: 1, 4, 8, 16; 0 = the widest that runs here");
    command.add_option("--set", o.settings, "key=value of the scene's settings; may be repeated")
        ->allow_extra_args(false);
}

Scene load_scene(const RunOptions& o) {
    Scene scene = read_scene(o.scene);
    Settings& s = scene.settings;
    auto apply = [&](const char* key, const auto& value) {
        if (value) apply_setting(s, std::string(key) + "=" + CLI::detail::to_string(*value));
    };
    auto apply_text = [&](const char* key, const std::string& value) {
        if (!value.empty()) apply_setting(s, std::string(key) + "=" + value);
    };
    apply_text("preset", o.preset);
    apply_text("method", o.method);
    apply_text("precision", o.precision);
    apply("duration", o.duration);
    apply("dt", o.dt);
    apply("substeps", o.substeps);
    apply("velocity_iterations", o.velocity_iterations);
    apply("position_iterations", o.position_iterations);
    apply("threads", o.threads);
    apply("lanes", o.lanes);
    for (const std::string& setting : o.settings) apply_setting(s, setting);
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
