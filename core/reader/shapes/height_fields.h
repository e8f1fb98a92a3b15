// SPDX-License-Identifier: MIT
/// Height fields of a scene: heights from the scene itself, or made by a rule.
#pragma once

#include "reader/drafts.h"

namespace plumb::reader {

void read_height_field(ShapeDraft& draft, const Node& node);

SchemaJson height_field_schema();
void add_height_field_definitions(SchemaJson& definitions);

}  // namespace plumb::reader
