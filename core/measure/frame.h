// SPDX-License-Identifier: MIT
/// What a run hands to whoever watches it: the bodies at one moment, and a few numbers about the
/// step.
#pragma once

#include "effects/residual.h"
#include "scene/geometry.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace plumb {

/// One body at one moment, world frame.
struct BodyState {
    Placement placement;               ///< of the geometry's frame, not of the centre of mass
    Eigen::Vector3d velocity;          ///< of the centre of mass [m/s]
    Eigen::Vector3d angular_velocity;  ///< [rad/s]
};

/// How far a step was from being solved (effects/residual.h). NaN where nobody told.
struct FrameResidual {
    /// Of the worst island: the force of its worst constraint, as a share of its weight.
    double force_of_weight = std::numeric_limits<double>::quiet_NaN();
    double force = std::numeric_limits<double>::quiet_NaN();  ///< of the worst constraint [N]
    double error = std::numeric_limits<double>::quiet_NaN();  ///< the same, of this or another [m]

    FrameResidual() = default;
    FrameResidual(const StepResidual& step)
        : force_of_weight(step.worst.force_of_weight()), force(step.force), error(step.error) {}
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
    FrameResidual residual;                          ///< of the step that ended here
};

}  // namespace plumb
