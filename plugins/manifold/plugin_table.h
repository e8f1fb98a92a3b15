// SPDX-License-Identifier: MIT
/// The table of a plugin that is a Collider: everything but its names.
#pragma once

#include "manifold/collider.h"

#include <array>

namespace plumb {

/// What a plugin can do with a pair when the shared builder makes its contacts.
std::uint32_t built_ability(ShapeKind a, ShapeKind b);

/// Marks in `table` what `ability` says of all pairs of kinds that are supported.
template <class Ability>
void fill_pairs(PluginTable& table, const Supported& supported, Ability ability) {
    for (std::uint32_t i = 0; i < kShapeKindCount; ++i)
        for (std::uint32_t j = 0; j < kShapeKindCount; ++j)
            if (supported.kind[i] && supported.kind[j])
                table.pairs[i][j] = ability(static_cast<ShapeKind>(i), static_cast<ShapeKind>(j));
}

/// What a near pair of two kinds costs [ns]: all kinds but compounds, which count as their parts.
inline constexpr std::size_t kCostedKinds = static_cast<std::size_t>(ShapeKind::compound);
using Costs = std::array<std::array<std::uint32_t, kCostedKinds>, kCostedKinds>;
void fill_costs(PluginTable& table, const Costs& costs);

/// PluginTable::create of a collider that is made from its number of threads.
template <class Kind>
Proximity* create_collider(const CreateRequest* request, const char** message) {
    try {
        return new Kind(request->threads);
    } catch (...) {
        if (message) *message = "memory ran out";
        return nullptr;
    }
}

/// PluginTable::destroy of the same.
template <class Kind>
void destroy_collider(Proximity* proximity) {
    delete static_cast<Kind*>(proximity);
}

/// A table with everything filled in but names, pairs and functions.
PluginTable blank_table();

}  // namespace plumb
