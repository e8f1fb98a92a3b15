// SPDX-License-Identifier: MIT
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reading.h"

namespace plumb::test {

namespace {

using Json = nlohmann::json;

Json schema() { return Json::parse(scene_schema()); }

/// Whether the reader's complaint about a text is an unknown key.
bool key_is_unknown(const std::string& text) {
    return std::string(error_of(text).what()).find("unknown key") != std::string::npos;
}

}  // namespace

TEST(Schema, ThatIsShippedIsTheReaders) {
    std::ifstream file(PLUMB_SAMPLES "/schema/plumb-scene.schema.json", std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_EQ(text.str(), scene_schema())
        << "write it anew: cmake --build BUILD --target plumb_scene_schema";
}

TEST(Schema, ReferencesAreDefined) {
    const Json json = schema();
    const std::string text = json.dump(), mark = "\"#/$defs/";
    int references = 0;
    for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
        const auto begin = at + mark.size();
        EXPECT_TRUE(json["$defs"].contains(text.substr(begin, text.find('"', begin) - begin)));
        ++references;
    }
    EXPECT_GT(references, 10);
}

TEST(Schema, NamesKeysThatTheReaderKnows) {
    const std::string joint =
        R"({"bodies": [{"name": "a", "mass": 1, "inertia": [1, 1, 1]}], "joints": [{"type": "hinge", "bodies": ["a"], )";
    // How an object of a definition gets into a scene; %s is a key with a value.
    const std::map<std::string, std::pair<std::string, std::string>> places = {
        {"settings", {R"({"settings": {)", "}}"}},
        {"material", {R"({"materials": {"m": {)", "}}}"}},
        {"material_pair", {R"({"material_pairs": [{)", "}]}"}},
        {"shape", {R"({"shapes": {"s": {)", "}}}"}},
        {"hills",
         {R"({"shapes": {"s": {"height_field": {"rows": 2, "columns": 2, "spacing": [1, 1], "hills": {)",
          "}}}}}"}},
        {"part", {R"({"shapes": {"s": {"compound": {"parts": [{)", "}]}}}}"}},
        {"rotation", {R"({"bodies": [{"rotation": {)", "}}]}"}},
        {"body", {R"({"bodies": [{)", "}]}"}},
        {"script", {R"({"bodies": [{"script": {)", "}}]}"}},
        {"keyframe", {R"({"bodies": [{"script": {"keyframes": [{)", "}]}}]}"}},
        {"grid", {R"({"bodies": [{"repeat": {)", "}}]}"}},
        {"repeat", {R"({"bodies": [{"repeat": {"count": [1, 1, 1]}, )", "}]}"}},
        {"prototype", {R"({"bodies": [{"repeat": {"count": [1, 1, 1]}, "bodies": [{)", "}]}]}"}},
        {"chain", {R"({"bodies": [{"chain": {)", "}}]}"}},
        {"chain_entry",
         {R"({"bodies": [{"chain": {"links": 1, "from": [0, 0, 0], "to": [1, 0, 0], "radius": 0.1}, )",
          "}]}"}},
        {"mobile", {R"({"bodies": [{"mobile": {)", "}}]}"}},
        {"mobile_entry", {R"({"bodies": [{"mobile": {"levels": 1}, )", "}]}"}},
        {"joint", {R"({"joints": [{)", "}]}"}},
        {"joint_axis", {joint + R"("axes": {"turn_x": {)", "}}}]}"}},
        {"motor", {joint + R"("motor": {)", "}}]}"}},
        {"spring", {joint + R"("spring": {)", "}}]}"}},
        {"coupling", {R"({"couplings": [{)", "}]}"}},
        {"robot", {R"({"robots": [{)", "}]}"}},
        {"robot_motor", {R"({"robots": [{"urdf": "x", "motors": {"m": {)", "}}}]}"}},
        {"deformable", {R"({"deformables": [{)", "}]}"}},
        {"deformable_repeat", {R"({"deformables": [{"repeat": {"count": [1, 1, 1]}, )", "}]}"}},
        {"deformable_prototype",
         {R"({"deformables": [{"repeat": {"count": [1, 1, 1]}, "deformables": [{)", "}]}]}"}},
        {"deformable_shape", {R"({"deformables": [{"kind": "cloth", "shape": {)", "}}]}"}},
        {"attachment",
         {R"({"deformables": [{"kind": "rope", "shape": {"line": {"from": [0, 0, 0], "to": [1, 0, 0]}}, "attach": [{)",
          "}]}]}"}},
        {"link", {R"({"links": [{)", "}]}"}},
        {"link_end", {R"({"links": [{"a": {)", "}}]}"}},
        {"view", {R"({"view": {)", "}}"}}};

    const Json definitions = schema()["$defs"];
    std::size_t visited = 0;
    for (const auto& [name, definition] : definitions.items()) {
        if (!definition.contains("properties")) continue;
        ++visited;
        ASSERT_TRUE(places.contains(name)) << name;
        const auto& [before, after] = places.at(name);
        for (const auto& property : definition["properties"].items()) {
            const std::string& key = property.key();
            if (name == key || name == key + "_entry" || name == "deformable_" + key)
                continue;  // it stands in `before`
            EXPECT_FALSE(key_is_unknown(before + '"' + key + "\": null" + after))
                << name << "/" << key;
        }
        EXPECT_TRUE(key_is_unknown(before + "\"no_such_key\": null" + after)) << name;
        EXPECT_EQ(definition["additionalProperties"], false) << name;
    }
    EXPECT_EQ(visited, places.size());
}

TEST(Schema, HasAKeyForEveryMemberOfSettings) {
    // This does not compile when Settings has members that are not listed here. Add them, and give
    // them a field in core/reader/settings.cpp.
    const Settings settings;
    [[maybe_unused]] const auto& [gravity, wind, gusts, gust_period, air_density, dt, duration,
                                  substeps, velocity_iterations, position_iterations, method,
                                  precision, threads, lanes, contacts, margin, reuse_distance,
                                  stiffness, recovery_speed, collision_depth, anchor_stiffness,
                                  gyroscopic, leapfrog_start, joints, exact_islands,
                                  accuracy, exact_deformables, multilevel, tree_parts,
                                  joint_tolerance, sleep_speed, sleep_time, warm_start,
                                  alternate_sweeps, shared_push, shared_cone, require, forbid] =
        settings;
    constexpr std::size_t kMembers = 38, kPreset = 1;
    EXPECT_EQ(schema()["$defs"]["settings"]["properties"].size(), kMembers + kPreset);
    for (const char* name : {"gravity",
                             "wind",
                             "gusts",
                             "gust_period",
                             "air_density",
                             "dt",
                             "duration",
                             "substeps",
                             "velocity_iterations",
                             "position_iterations",
                             "method",
                             "precision",
                             "threads",
                             "lanes",
                             "contacts",
                             "margin",
                             "stiffness",
                             "recovery_speed",
                             "collision_depth",
                             "anchor_stiffness",
                             "gyroscopic",
                             "leapfrog_start",
                             "joints",
                             "exact_islands",
                             "accuracy",
                             "exact_deformables",
                             "multilevel",
                             "sleep_speed",
                             "sleep_time",
                             "tree_parts",
                             "joint_tolerance",
                             "warm_start",
                             "alternate_sweeps",
                             "shared_push",
                             "shared_cone",
                             "require",
                             "forbid"}) {
        EXPECT_TRUE(schema()["$defs"]["settings"]["properties"].contains(name)) << name;
    }
}

}  // namespace plumb::test
