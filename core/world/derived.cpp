// SPDX-License-Identifier: MIT
#include "world/derived.h"

#include <algorithm>
#include <cmath>

namespace plumb {

void assign_rows(World& world) {
    Bodies& b = world.bodies;
    world.dynamic_count = world.kinematic_count = 0;
    for (Motion m : b.motion) {
        world.dynamic_count += m == Motion::dynamic;
        world.kinematic_count += m == Motion::kinematic;
    }
    std::int32_t dynamic = 0, kinematic = world.moving_count();
    for (std::size_t i = 0; i < b.size(); ++i)
        b.row[i] = b.motion[i] == Motion::dynamic     ? dynamic++
                   : b.motion[i] == Motion::kinematic ? kinematic++
                                                      : world.zero_row();
    world.body_of_row.resize(static_cast<std::size_t>(world.dynamic_count));
    for (std::uint32_t i = 0; i < b.size(); ++i)
        if (b.motion[i] == Motion::dynamic)
            world.body_of_row[static_cast<std::size_t>(b.row[i])] = i;
}

void combine_surfaces(World& world, const Scene& scene) {
    const auto n = static_cast<std::uint32_t>(scene.materials.size());
    world.material_count = n;
    world.surface_pairs.resize(std::size_t(n) * n);
    for (std::uint32_t a = 0; a < n; ++a)
        for (std::uint32_t b = 0; b < n; ++b) {
            const Material &x = scene.materials[a], &y = scene.materials[b];
            world.surface_pairs[a * n + b] = {std::sqrt(x.friction * y.friction),
                                              std::max(x.restitution, y.restitution),
                                              std::max(x.rolling_friction, y.rolling_friction),
                                              std::max(x.spinning_friction, y.spinning_friction)};
        }
    for (const MaterialPair& pair : scene.material_pairs)
        for (auto [a, b] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)}) {
            SurfacePair& s = world.surface_pairs.at(std::size_t(a) * n + b);
            s.friction = pair.friction.value_or(s.friction);
            s.restitution = pair.restitution.value_or(s.restitution);
            s.rolling_friction = pair.rolling_friction.value_or(s.rolling_friction);
            s.spinning_friction = pair.spinning_friction.value_or(s.spinning_friction);
        }
}

}  // namespace plumb
