// SPDX-License-Identifier: MIT
/// One shape that stands on another along +y, for every pair of kinds: at height 0 they touch.
#pragma once

#include "harness.h"

#include <optional>
#include <vector>

namespace plumb::test {

using Outline = std::vector<Eigen::Vector2d>;  ///< counter-clockwise, (x, z) seen from below [m]

/// A shape with its highest or lowest point at y = 0, and what it shows there.
struct Standing {
    Shape shape;
    Place place;
    int points;       ///< that its touching area needs: 1 point, 2 segment, 4 face
    Outline outline;  ///< of a face; empty otherwise, and where its area is not simple
};

/// The lower of two: its top is at y = 0. `size` is about half its width [m].
Standing below(ShapeKind kind, double size);

/// The upper of two: its bottom is at y = 0. Nothing for kinds that cannot stand on another.
std::optional<Standing> above(ShapeKind kind, double size);

/// A lower and an upper shape that a plugin claims to detect.
struct Stack {
    Standing lower, upper;
    std::uint32_t ability;

    int points() const { return std::min(lower.points, upper.points); }
    std::string name() const;
};

/// All stacks that a plugin claims; a mesh that may not move is fixed, whichever it is.
std::vector<Stack> stacks(const std::string& plugin, double size = 0.3);

/// From here on `stacks` has only those of two kinds, either on the other.
using KindPair = std::pair<ShapeKind, ShapeKind>;
void choose_pair(const KindPair& pair);

/// Puts the lower body at id `lower` and the other at 3 − lower, the upper one `gap` higher.
void build(World& world, const Stack& stack, double gap, const Place& frame = {},
           std::uint32_t lower = 1);

/// The area that two convex outlines share [m²].
double shared_area(const Outline& a, const Outline& b);

}  // namespace plumb::test
