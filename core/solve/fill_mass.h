// SPDX-License-Identifier: MIT
/// A body's inverse mass and inertia into one lane of a block.
#pragma once

#include "world/bodies.h"

namespace plumb {

template <class Real, int W>
inline void fill_mass(const Bodies& bodies, std::uint32_t body, Real (&mass)[W],
                      Real (&inertia)[6][W], std::uint32_t lane) {
    mass[lane] = static_cast<Real>(bodies.inverse_mass[body]);
    const Symmetric3<double>& i = bodies.world_inverse_inertia[body];
    const double entries[6] = {i.xx, i.yy, i.zz, i.xy, i.xz, i.yz};
    for (int e = 0; e < 6; ++e) inertia[e][lane] = static_cast<Real>(entries[e]);
}

}  // namespace plumb
