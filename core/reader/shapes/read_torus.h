// SPDX-License-Identifier: MIT
/// A "torus" of a scene.
#pragma once

#include "reader/drafts.h"

namespace plumb::reader {

void read_torus(ShapeDraft& draft, const Node& node);
SchemaJson torus_schema();

}  // namespace plumb::reader
