// SPDX-License-Identifier: MIT
/// What contacts bore that are solved as one with deformables, from one step to the next.
#pragma once

#include "math/types.h"

#include <array>
#include <cstdint>
#include <tuple>

namespace plumb {

/// Of a particle, or three of a triangle, with a body; or of these with a particle, `part`.
struct ElasticImpulse {
    std::array<std::uint32_t, 3> particles;  ///< or kNoIndex
    std::uint32_t body, part;                ///< body: or kNoIndex
    std::uint64_t feature;                   ///< as of plumb::Contact, or 0
    std::uint32_t order;  ///< among all of the step: of those with one key, which is which
    Vector3d impulse;     ///< on the particles [N s]

    auto key() const { return std::tie(particles, body, part, feature); }
    bool operator<(const ElasticImpulse& b) const {
        return key() != b.key() ? key() < b.key() : order < b.order;
    }
};

}  // namespace plumb
