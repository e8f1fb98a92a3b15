// SPDX-License-Identifier: MIT
/// Heaps of bodies of about 10 cm in a bin a little wider than five of them.
#pragma once

#include "support/random.h"
#include "support/scenes.h"

#include <vector>

namespace plumb::test {

inline constexpr double kBinHalf = 0.27;  ///< of the bin, between its walls [m]

/// Bodies 0 to 4: the ground and four walls, of half the height `half_height` [m]. All that touches
/// resists rolling a little.
inline void add_bin(Scene& s, double half_height) {
    s.materials[0].rolling_friction = 0.005;
    add_ground(s);
    for (const Vector& d : {Vector(1, 0, 0), Vector(-1, 0, 0), Vector(0, 0, 1), Vector(0, 0, -1)}) {
        const double wide = kBinHalf + 0.4, away = kBinHalf + 0.2;
        const Vector half = Vector(wide, half_height, wide) - away * d.cwiseAbs();
        add_body(s, box(half.x(), half.y(), half.z()), away * d + Vector(0, half_height, 0),
                 Motion::fixed);
    }
}

/// Bodies that fall into it: layers of nine, one shape after another, each turned at random.
inline void add_layers(Scene& s, const std::vector<Geometry>& shapes, std::uint32_t count) {
    Random random(3);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double x = i % 3 - 1.0, z = (i / 3) % 3 - 1.0, layer = i / 9;
        BodySpec& body =
            add_body(s, shapes[i % shapes.size()], {0.175 * x, 0.1 + 0.18 * layer, 0.175 * z});
        body.placement.rotation = random.rotation();
    }
}

}  // namespace plumb::test
