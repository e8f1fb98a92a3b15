// SPDX-License-Identifier: MIT
/// A scene as MuJoCo's own description.
#pragma once

#include "world/world.h"

#include <string>

namespace plumb::bench {

std::string body_name(std::size_t body);

/// As MuJoCo calls them.
struct MujocoMethod {
    const char *integrator, *cone;
};

/// `dt`: step [s].
std::string mjcf(const Scene& scene, const World& world, double dt, const MujocoMethod& method);

}  // namespace plumb::bench
