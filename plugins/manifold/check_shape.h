// SPDX-License-Identifier: MIT
/// Whether a shape can exist at all, whatever the back-end.
#pragma once

#include <plumb/shape.h>

namespace plumb {

/// What is wrong with a shape, as a sentence, or nullptr. A compound is checked part by part.
const char* flaw_of(const Shape& shape);

}  // namespace plumb
