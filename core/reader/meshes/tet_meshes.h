// SPDX-License-Identifier: MIT
/// Tetrahedra, or triangles, from files of mesh generators.
#pragma once

#include <filesystem>

#include "reader/deformables/deformable_shapes.h"

namespace plumb::reader {

/// Gmsh's .msh, ASCII, of version 2.2 or 4.1: its tetrahedra, or else its triangles, and the points
/// that they use. Elements of lower dimension are left out. Throws BadShape, which names the line.
Elements load_gmsh(const std::filesystem::path& file, bool tetrahedra);

/// TetGen's .node, counted from 0 or 1, with the .ele beside it: its tetrahedra and the points that
/// they use. Throws BadShape, which names the file and the line.
Elements load_tetgen(const std::filesystem::path& node_file);

}  // namespace plumb::reader
