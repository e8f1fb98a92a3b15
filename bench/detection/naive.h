// SPDX-License-Identifier: MIT
/// A collision package driven the plain way: its own broad phase over all bodies and its own
/// contact function on each pair, in every step. What a plugin is measured against.
#pragma once

#include "scene/scene.h"

#include <memory>

namespace plumb::bench {

class NaiveDetector {
public:
    virtual ~NaiveDetector() = default;

    /// Takes the pose of body i's geometry.
    virtual void move(std::size_t i, const Placement& placement) = 0;

    /// Finds the contacts at the poses now; returns how many points there are.
    virtual std::size_t detect() = 0;
};

/// Knows planes, boxes and spheres; anything else ends the program.
std::unique_ptr<NaiveDetector> make_naive(const Scene& scene);

/// The plugin on the same package.
extern const char* const kPlugin;

}  // namespace plumb::bench
