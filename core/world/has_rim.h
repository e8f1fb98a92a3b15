// SPDX-License-Identifier: MIT
/// Which shapes have a flat round end, along whose rim a contact runs when they roll.
#pragma once

#include "world/world.h"

#include <algorithm>

namespace plumb {

inline bool has_rim(ShapeKind kind) {
    return kind == ShapeKind::cylinder || kind == ShapeKind::cone;
}
inline bool has_rim(const Shape& shape) {
    if (shape.kind != ShapeKind::compound) return has_rim(shape.kind);
    return std::any_of(shape.parts, shape.parts + shape.part_count,
                       [](const ShapePart& part) { return has_rim(part.shape); });
}
inline bool has_rim(const World& world, std::uint32_t body) {
    const std::uint32_t geometry = world.bodies.geometry[body];
    return geometry != kNoIndex && has_rim(world.shapes[geometry]);
}

}  // namespace plumb
