// SPDX-License-Identifier: MIT
/// Triangles from an STL file, of bytes or of text.
#pragma once

#include <filesystem>

#include "reader/meshes/obj.h"

namespace plumb::reader {

/// All facets of a file as one mesh; corners at the very same point are one vertex, and facets
/// without area are left out. Throws BadShape when the file cannot be read, has no facets, or has
/// numbers that are not finite.
TriangleMesh load_stl(const std::filesystem::path& file);

}  // namespace plumb::reader
