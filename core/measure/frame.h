// SPDX-License-Identifier: MIT
/// What a run hands to whoever watches it: the bodies at one moment, and a few numbers about the
/// step.
#pragma once

#include "scene/geometry.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

/// One body at one moment, world frame.
struct BodyState {
    Placement placement;               ///< of the geometry's frame, not of the centre of mass
    Eigen::Vector3d velocity;          ///< of the centre of mass [m/s]
    Eigen::Vector3d angular_velocity;  ///< [rad/s]
};

struct Frame {
    std::uint64_t step = 0;
    double time = 0;                 ///< [s]
    std::vector<BodyState> bodies;   ///< [body], in the order of Scene::bodies
    std::vector<std::uint32_t> ids;  ///< [body] World::bodies.id, or none where all live since the
                                     ///< start: a body's identifier, kNoIndex of a vacant place
    std::vector<Eigen::Vector3d> particles;  ///< places of the points of Scene::deformables, one
                                             ///< deformable after another [m]
    std::vector<std::array<std::uint32_t, 2>> torn;  ///< (deformable, element of it) that have
                                                     ///< torn since the start, sorted
    std::uint32_t contacts = 0;                      ///< contact points
    double kinetic_energy = 0;                       ///< [J]
    double potential_energy = 0;                     ///< of gravity, against the origin [J]
    double deepest_penetration = 0;                  ///< [m], ≥ 0
};

}  // namespace plumb
