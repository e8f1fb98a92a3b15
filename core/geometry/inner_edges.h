// SPDX-License-Identifier: MIT
/// Edges between two triangles of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace plumb {

/// {a, b, c, d}: the edge a → b as the triangle (a, b, c) has it, and (b, a, d) on its other side;
/// in the order of the edges' points.
inline std::vector<std::array<std::uint32_t, 4>> inner_edges(
    const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> across;  // a → b: c
    for (const auto& t : triangles)
        for (int k = 0; k < 3; ++k) across[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
    std::vector<std::array<std::uint32_t, 4>> edges;
    for (const auto& [edge, c] : across) {
        if (edge.first > edge.second) continue;
        const auto other = across.find({edge.second, edge.first});
        if (other != across.end()) edges.push_back({edge.first, edge.second, c, other->second});
    }
    return edges;
}

}  // namespace plumb
