// SPDX-License-Identifier: MIT
/// How the triangles of a surface hang together.
///
/// Goes in: triangles over vertices of which no two are in one place. Comes out: what lies across
/// each edge, and whether the surface bends there towards its back (convex), towards its front
/// (concave) or not at all; and, for each vertex, the vertices that an edge joins to it.
#pragma once

#include "manifold/linear.h"

#include <cstdint>
#include <vector>

namespace plumb {

enum class EdgeKind : std::uint8_t {
    open,  ///< no triangle across it, or no clear one: more than two, or turned the other way
    convex,
    flat,  ///< bends by less than kFlat
    concave
};

inline constexpr double kFlat = 1e-4;  ///< sine of the bend, and of what counts as one direction
inline constexpr std::uint32_t kNoFacet = 0xffffffffu;

/// One triangle. Edge i runs from corner i to corner i + 1, and faces corner i + 2.
struct Facet {
    std::uint32_t corner[3];  ///< vertices, counter-clockwise seen from the front
    std::uint32_t across[3];  ///< facet behind each edge, or kNoFacet
    std::uint32_t id;         ///< as the shape numbers its triangles
    EdgeKind edge[3];
    Vec3 normal;  ///< unit, out of the front, shape frame; 0 where the triangle has no area
};

struct MeshTopology {
    const Vec3* vertices = nullptr;         ///< shape frame [m]; of the surface
    std::vector<Facet> facets;              ///< as the surface counts its triangles
    std::vector<std::uint32_t> ring_begin;  ///< [vertex + 1] where its neighbours begin in `ring`
    std::vector<std::uint32_t> ring;        ///< vertices
    std::vector<std::uint32_t> facet_of;    ///< [vertex] its first facet, or kNoFacet

    /// Adds a facet that is not joined to others yet.
    void add(const std::uint32_t (&corner)[3], std::uint32_t id, Vec3 normal);

    /// Joins all facets, over vertices that stay where they are.
    void connect(const std::vector<Vec3>& all);
};

}  // namespace plumb
