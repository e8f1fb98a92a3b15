// SPDX-License-Identifier: MIT
/// Bytes made small (zlib) and made text (base64).
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// The bytes in zlib's format (RFC 1950).
std::string deflated(std::string_view bytes);

/// The bytes as base64 (RFC 4648), on one line.
std::string base64(std::string_view bytes);

}  // namespace plumb
