// SPDX-License-Identifier: MIT
/// The header of a recording as JSON text, and back.
#pragma once

#include "output/recording.h"

#include <string>
#include <string_view>

namespace plumb {

/// Bytes in names that are no UTF-8 are replaced.
std::string header_to_json(const RecordingHeader& header);

/// Throws std::exception on text that is no header.
RecordingHeader header_from_json(std::string_view text);

}  // namespace plumb
