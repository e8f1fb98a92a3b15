// SPDX-License-Identifier: MIT
/// Random shapes, pairs of them at a known gap, and heaps of them: of the kinds that a plugin
/// claims.
#pragma once

#include "dice.h"
#include "exact.h"
#include "harness.h"

#include <vector>

namespace plumb::test {

/// Two shapes at a known signed gap.
struct NearPair {
    Shape a, b;
    Place pa, pb;
    double gap;      ///< exact where both are boxes or hulls, else not above the true one [m]
    V n;             ///< along which the gap is measured, out of b towards a
    bool polyhedra;  ///< both are boxes or hulls: gap, n and second are exact
    double second;   ///< the gap along the next best axis that points elsewhere [m]
};

/// The convex kinds that fill some volume: all but planes, meshes, height fields and compounds.
const std::vector<ShapeKind>& solid_kinds();

/// A shape of about half a metre.
Shape any_shape(ShapeKind kind, Dice& dice);

/// Two random solids, brought to a gap along their best axis: that leaves no better one.
NearPair near_pair(ShapeKind a, ShapeKind b, double gap, Dice& dice);

/// The solid kinds that a plugin claims for each other, all with all.
std::vector<ShapeKind> mutual_kinds(const std::string& name);

/// Throws `count` bodies of those kinds together. `backwards`: with their ids in reverse order.
void throw_heap(World& world, const std::string& name, unsigned seed, std::uint32_t count,
                const Place& frame = {}, bool backwards = false);

/// The contacts of one pair at its place, moved as a whole by `frame`, a under the given id.
std::vector<Contact> contacts_of(const std::string& name, const NearPair& pair, double margin,
                                 const Place& frame = {}, bool a_first = true);

}  // namespace plumb::test
