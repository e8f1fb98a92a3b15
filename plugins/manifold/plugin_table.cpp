// SPDX-License-Identifier: MIT
#include "manifold/plugin_table.h"

namespace plumb {

std::uint32_t built_ability(ShapeKind a, ShapeKind b) {
    constexpr std::uint32_t full = kPairPoint | kPairManifold | kPairSeparated | kPairThreadSafe;
    const auto has = [&](ShapeKind k) { return a == k || b == k; };
    if (a == b && a == ShapeKind::plane) return kPairNone;
    if (!has_surface(a) && !has_surface(b)) return full;
    // A height field has no inside that a mesh or a half-space could be measured against.
    const bool other = has(ShapeKind::mesh) || has(ShapeKind::plane) || a == b;
    if (has(ShapeKind::height_field) && other) return kPairNone;
    return full | kPairMovingMesh;
}

void fill_costs(PluginTable& table, const Costs& costs) {
    for (std::size_t i = 0; i < kCostedKinds; ++i)
        for (std::size_t j = 0; j < kCostedKinds; ++j) table.costs[i][j] = costs[i][j];
}

PluginTable blank_table() {
    PluginTable t{};
    t.magic = kPluginMagic;
    t.abi_major = kAbiMajor;
    t.abi_minor = kAbiMinor;
    t.table_size = sizeof(PluginTable);
    t.sizes = abi_sizes();
    t.precision = "double";
    return t;
}

}  // namespace plumb
