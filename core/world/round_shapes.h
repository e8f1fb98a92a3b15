// SPDX-License-Identifier: MIT
/// Which shapes roll, and which have a flat round end, along whose rim a contact runs then.
#pragma once

#include "world/world.h"

#include <algorithm>

namespace plumb {

inline bool has_rim(ShapeKind kind) {
    return kind == ShapeKind::cylinder || kind == ShapeKind::cone;
}
inline bool is_round(ShapeKind kind) {
    return kind == ShapeKind::sphere || kind == ShapeKind::capsule || has_rim(kind);
}

/// Whether a body's shape, or a part of it, is of a kind that `is` says yes to.
inline bool has_part(const World& world, std::uint32_t body, bool (*is)(ShapeKind)) {
    const std::uint32_t geometry = world.bodies.geometry[body];
    if (geometry == kNoIndex) return false;
    const Shape& shape = world.shapes[geometry];
    if (shape.kind != ShapeKind::compound) return is(shape.kind);
    return std::any_of(shape.parts, shape.parts + shape.part_count,
                       [is](const ShapePart& part) { return is(part.shape.kind); });
}
inline bool has_rim(const World& world, std::uint32_t body) {
    return has_part(world, body, [](ShapeKind kind) { return has_rim(kind); });
}
inline bool is_round(const World& world, std::uint32_t body) {
    return has_part(world, body, [](ShapeKind kind) { return is_round(kind); });
}

}  // namespace plumb
