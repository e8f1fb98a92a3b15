// SPDX-License-Identifier: MIT
/// Shapes with what the tests know of them apart from any collider: which points are inside, and
/// many points of the surface.
#pragma once

#include "harness.h"

#include <functional>
#include <random>

namespace plumb::test {

struct Solid {
    const char* name;
    Shape shape;
    std::function<bool(const V&)> inside;  ///< in the shape's frame
    std::vector<V> surface;                ///< dense samples, in the shape's frame
    double spacing;                        ///< no point of the surface is farther from a sample [m]
};

/// One solid of every bounded convex kind and a torus mesh; those that the plugin takes.
std::vector<Solid> solids_of(const std::string& plugin);

/// How often a mesh winds around a point: 1 inside, 0 outside.
double winding(const Shape& mesh, const V& p);

/// Random numbers and places.
struct Dice {
    explicit Dice(unsigned seed) : engine(seed) {}
    double number(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine);
    }
    V within(double half) {
        return {number(-half, half), number(-half, half), number(-half, half)};
    }
    V direction() {
        std::normal_distribution<double> normal;
        return V(normal(engine), normal(engine), normal(engine)).normalized();
    }
    Q rotation() {
        std::normal_distribution<double> normal;
        return Q(normal(engine), normal(engine), normal(engine), normal(engine)).normalized();
    }
    std::mt19937 engine;
};

}  // namespace plumb::test
