// SPDX-License-Identifier: MIT
/// Meshes and height fields for tests. Memory behind them lives until the end of the process.
#pragma once

#include "harness.h"

#include <array>

namespace plumb::test {

using Triangle = std::array<std::uint32_t, 3>;

Shape mesh(const std::vector<V>& vertices, const std::vector<Triangle>& triangles);

/// Two triangles over |x|, |z| ≤ half, at y = 0, facing +y.
Shape quad_mesh(double half);

/// Two faces that meet at the z-axis and fall off to both sides by `slope` [rad]; rise where
/// negative.
Shape roof_mesh(double slope, double half);

/// A closed cube whose faces have `cells` × `cells` × 2 triangles; every face has its own vertices.
Shape cube_mesh(double half, int cells);

/// A closed sphere of `rings` rings about y, all vertices on the sphere.
Shape sphere_mesh(double radius, int rings);

/// The triangles of a height field as a mesh, in the same order.
Shape mesh_of(const Shape& field);

}  // namespace plumb::test
