// SPDX-License-Identifier: MIT
/// JSON with comments from text. Errors name line and column; a key that stands twice is an error.
#pragma once

#include <string_view>

#include "reader/json/node.h"

namespace plumb::reader {

Json parse_json(std::string_view text, const Source& source);

}  // namespace plumb::reader
