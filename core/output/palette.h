// SPDX-License-Identifier: MIT
/// Colours of what the user gave none: pleasant side by side, and the same in every picture.
#pragma once

#include "output/recording.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace plumb {

/// Scatters an index over all 32 bits, so that neighbours differ.
inline std::uint32_t scattered(std::uint32_t i) {
    i = (i ^ (i >> 16)) * 0x7feb352du;
    i = (i ^ (i >> 15)) * 0x846ca68bu;
    return i ^ (i >> 16);
}

/// sRGB colour of a body, 0xRRGGBB.
inline std::uint32_t body_color(const RecordedBody& body, std::size_t index) {
    if (body.color != 0) return body.color & 0xffffffu;
    if (body.motion == Motion::fixed) return 0x9aa3ac;
    if (body.motion == Motion::kinematic) return 0x5b6675;
    constexpr std::array<std::uint32_t, 8> kColors{0xe4572e, 0xf2a541, 0xf3d9a4, 0x2e86ab,
                                                   0x5fb0b7, 0x1b4965, 0xc8553d, 0x7fb069};
    return kColors[scattered(static_cast<std::uint32_t>(index)) % kColors.size()];
}

/// sRGB colour of a deformable, 0xRRGGBB.
inline std::uint32_t deformable_color(const RecordedDeformable& deformable, std::size_t index) {
    if (deformable.color != 0) return deformable.color & 0xffffffu;
    if (deformable.kind == DeformableKind::rope) return 0xc9ad7f;
    constexpr std::array<std::uint32_t, 6> kColors{0xc8434f, 0x2e86ab, 0xedae49,
                                                   0x5f9f6e, 0x8d6a9f, 0x3d5a80};
    return kColors[index % kColors.size()];
}

inline constexpr std::uint32_t kLinkColor = 0x4a5560;  ///< sRGB, 0xRRGGBB

}  // namespace plumb
