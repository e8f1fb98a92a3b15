// SPDX-License-Identifier: MIT
/// Shapes made of points and triangles: hull, mesh, and compounds of hulls from a file.
#pragma once

#include "reader/drafts.h"

namespace plumb::reader {

void read_hull(ShapeDraft& draft, const Node& node);
void read_mesh(ShapeDraft& draft, const Node& node);

/// The convex hull of points; throws BadShape as `convex_hull` does.
Geometry hull_geometry(const std::vector<Eigen::Vector3d>& points);

/// One hull for each object or group of an OBJ file; `node` holds the file's name.
std::vector<GeometryPart> hulls_of_file(const Node& node, double scale);

SchemaJson hull_schema();
SchemaJson mesh_schema();

inline constexpr Range kScale{1e-6, 1e6};  ///< factor on the coordinates of a mesh file

}  // namespace plumb::reader
