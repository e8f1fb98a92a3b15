// SPDX-License-Identifier: MIT
/// Scenes from JSON: text in, a checked `Scene` out.
///
/// The text is JSON with // and /* */ comments; samples/schema/plumb-scene.schema.json describes
/// every key. Meshes are named relative to the folder of the scene's file. Whatever is wrong comes
/// back as one `SceneError` with the file, the JSON pointer, what is allowed, and the nearest
/// spelling of a name that is unknown.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/error.h"
#include "scene/scene.h"

namespace plumb {

/// Most bodies that a scene may have, those of "repeat" entries counted one by one.
inline constexpr std::size_t kMaxBodies = 1'000'000;

/// Most points that its deformables may have together.
inline constexpr std::size_t kMaxParticles = 1'000'000;

/// Reads a scene's file, or a robot's, whose name ends in .urdf (robots/robot.h).
Scene read_scene(const std::filesystem::path& file);

/// Reads a scene from text. `origin` names the text in errors, and its folder is where meshes are
/// looked for.
Scene parse_scene(std::string_view text, const std::filesystem::path& origin);

/// Applies one "key=value" to settings, with the checks and the keys of a scene's "settings".
///
/// The value is JSON ("0.005", "true", "[0,-9.81,0]"); a text needs no quotes ("precision=double"),
/// and a list no brackets ("gravity=0,-9.81,0").
void apply_setting(Settings& settings, std::string_view key_equals_value);

/// The JSON Schema (draft 2020-12) of the format, made from the tables that the reader itself works
/// by.
std::string scene_schema();

}  // namespace plumb
