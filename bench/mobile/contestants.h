// SPDX-License-Identifier: MIT
/// Who runs the mobile: Plumb in its ways, and ODE's quick step.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace plumb::bench {

struct Contestant {
    std::string name;
    std::function<void()> step;   ///< advances by Settings::dt
    std::function<double()> gap;  ///< widest gap of a joint [m]
};

/// The mobile on ODE's quick step with `iterations`. ODE must be initialised.
Contestant ode_mobile(const Scene& scene, int iterations);

/// The mobile on Plumb, with the settings of the scene.
Contestant plumb_mobile(const Scene& scene, const std::string& name);

}  // namespace plumb::bench
