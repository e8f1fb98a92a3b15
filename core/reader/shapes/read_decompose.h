// SPDX-License-Identifier: MIT
/// "decompose" of a mesh: options of its parts.
#pragma once

#include "geometry/decompose.h"
#include "reader/drafts.h"

namespace plumb::reader {

/// true, or an object with options.
void read_decompose(DecomposeOptions& options, const Node& node);
SchemaJson decompose_schema();

}  // namespace plumb::reader
