// SPDX-License-Identifier: MIT
/// plumb colliders: what is installed, its version, and what it can do.
#include "app/check_collider.h"
#include "app/plugin_path.h"
#include "app/verbs.h"
#include "host/collider_library.h"
#include "host/log.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace plumb::app {
namespace {

using Json = nlohmann::ordered_json;

/// One letter for what a plugin can do with a pair: M manifold, p points, m mesh may move, .
/// nothing.
char ability_letter(std::uint32_t ability) {
    if (ability & kPairMovingMesh) return 'm';
    if (ability & kPairManifold) return 'M';
    return ability & kPairPoint ? 'p' : '.';
}

void print_pairs(const PluginTable& table) {
    std::printf("    %-13s", "");
    for (std::uint32_t k = 0; k < kShapeKindCount; ++k)
        std::printf(" %-6.6s", name_of(static_cast<ShapeKind>(k)));
    std::printf("\n");
    for (std::uint32_t a = 0; a < kShapeKindCount; ++a) {
        std::printf("    %-13s", name_of(static_cast<ShapeKind>(a)));
        for (std::uint32_t b = 0; b < kShapeKindCount; ++b)
            std::printf(" %-6c", ability_letter(table.pairs[a][b]));
        std::printf("\n");
    }
}

/// What a plugin can do with a pair, in words.
std::vector<std::string> ability_names(std::uint32_t ability) {
    std::vector<std::string> names;
    const auto add = [&](std::uint32_t bit, const char* name) {
        if (ability & bit) names.emplace_back(name);
    };
    add(kPairPoint, "point");
    add(kPairManifold, "manifold");
    add(kPairSeparated, "separated");
    add(kPairThreadSafe, "thread_safe");
    add(kPairMovingMesh, "moving_mesh");
    return names;
}

Json pairs_json(const PluginTable& table) {
    Json pairs = Json::array();
    for (std::uint32_t a = 0; a < kShapeKindCount; ++a)
        for (std::uint32_t b = a; b < kShapeKindCount; ++b)
            if (table.pairs[a][b] != kPairNone)
                pairs.push_back({{"a", name_of(static_cast<ShapeKind>(a))},
                                 {"b", name_of(static_cast<ShapeKind>(b))},
                                 {"can", ability_names(table.pairs[a][b])}});
    return pairs;
}

Json collider_json(const ColliderInfo& c) {
    Json j{{"name", c.name}, {"file", c.file.string()}};
    if (!c.table) {
        j["refused"] = c.refusal;
        return j;
    }
    const auto abi = std::to_string(c.table->abi_major) + "." + std::to_string(c.table->abi_minor);
    j["version"] = c.table->backend_version;
    j["precision"] = c.table->precision;
    j["interface"] = abi;
    j["description"] = c.table->description;
    j["pairs"] = pairs_json(*c.table);
    return j;
}

int list_json(const std::string& path) {
    Json all = Json::array();
    const ColliderLibrary library(path);
    for (const ColliderInfo& c : library.all()) all.push_back(collider_json(c));
    // a file's name may be no valid text
    std::puts(all.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return kDone;
}

int list(const std::string& path, bool pairs) {
    const ColliderLibrary library(path);
    if (library.all().empty())
        logger()->error("no collision plugin was found in {}", library.searched());
    for (const ColliderInfo& c : library.all()) {
        if (!c.table) {
            std::printf("%-12s refused: %s\n    %s\n", c.name.c_str(), c.refusal.c_str(),
                        c.file.c_str());
            continue;
        }
        std::printf("%-12s %s, %s precision, plugin interface %u.%u\n    %s\n    %s\n",
                    c.name.c_str(), c.table->backend_version, c.table->precision,
                    c.table->abi_major, c.table->abi_minor, c.table->description, c.file.c_str());
        if (pairs) print_pairs(*c.table);
    }
    if (pairs)
        std::printf("M full manifold   m the same, and meshes may move   p points   . nothing\n");
    return kDone;
}

}  // namespace

Verb add_colliders(CLI::App& command) {
    struct Options {
        std::string path, checked;
        bool short_list = false, json = false;
    };
    auto options = std::make_shared<Options>();
    add_plugin_path_option(command, options->path);
    command.add_flag("--short", options->short_list, "without the tables of pairs");
    command.add_flag("--json", options->json, "as JSON");
    const CLI::Option* check = command.add_option(
        "--check", options->checked, "run the conformance suite on one plugin, by name or by file");
    return [options, check] {
        if (check->count() > 0) return check_collider(options->checked, options->path);
        if (options->json) return list_json(options->path);
        return list(options->path, !options->short_list);
    };
}

}  // namespace plumb::app
