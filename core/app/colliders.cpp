// SPDX-License-Identifier: MIT
/// plumb colliders: what is installed, its version, and what it can do.
#include "app/verbs.h"
#include "host/collider_library.h"

#include <cstdio>
#include <memory>

namespace plumb::app {
namespace {

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

int list(const std::string& path, bool pairs) {
    const ColliderLibrary library(path);
    if (library.all().empty()) std::fprintf(stderr, "plumb: no collision plugin was found\n");
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
        std::string path;
        bool short_list = false;
    };
    auto options = std::make_shared<Options>();
    command.add_option("--plugin-path", options->path,
                       "directories to look for plugins in first, separated by ':'");
    command.add_flag("--short", options->short_list, "without the tables of pairs");
    return [options] { return list(options->path, !options->short_list); };
}

}  // namespace plumb::app
