// SPDX-License-Identifier: MIT
/// Differences modulo 2^16 as codes that are small where the difference is small either way.
#pragma once

#include <cstdint>

namespace plumb {

/// 0, −1, 1, −2, … as 0, 1, 2, 3, …
inline std::uint16_t zigzag(std::uint16_t difference) {
    const auto value = static_cast<std::int16_t>(difference);
    return static_cast<std::uint16_t>((difference << 1) ^ (value >> 15));
}

}  // namespace plumb
