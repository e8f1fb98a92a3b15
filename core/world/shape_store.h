// SPDX-License-Identifier: MIT
/// Geometries as the contract's plain shapes, with the memory that those point to.
#pragma once

#include <plumb/shape.h>

#include "scene/geometry.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace plumb {

/// Shapes keep their addresses until the store is destroyed.
class ShapeStore {
public:
    /// Adds a geometry and returns its shape. Throws SceneError for faces of corners that there are
    /// not, and for height fields that lack heights.
    const Shape& add(const Geometry& geometry);

    const Shape& operator[](std::size_t geometry) const { return shapes_[geometry]; }

private:
    Shape make(const Geometry& geometry);

    std::deque<Shape> shapes_;
    std::deque<std::vector<Vec3>> points_;
    std::deque<std::vector<std::uint32_t>> indices_;
    std::deque<std::vector<double>> heights_;
    std::deque<std::vector<ShapePart>> parts_;
};

}  // namespace plumb
