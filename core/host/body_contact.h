// SPDX-License-Identifier: MIT
/// What a Simulation tells of the contacts of its last step. Bodies are given by their identifiers.
///
/// Impulses are sums over all substeps, of whatever pushed: impacts, both passes, islands solved
/// exactly, shock propagation (of which the lower body feels less). A touch that began and ended
/// inside of the step has its impulse, too. Points, gaps and `touches` are those at its end.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

namespace plumb {

/// A point at which two bodies touch, or are as near as the step looks out for.
struct BodyContact {
    std::uint32_t body_a, body_b;          ///< body_a < body_b
    std::uint32_t part_a, part_b;          ///< part of a compound, triangle of a mesh; else 0
    std::uint32_t material_a, material_b;  ///< indices into Scene::materials, or of add_material
    Eigen::Vector3d point_a, point_b;      ///< on the bodies' surfaces [m]
    Eigen::Vector3d normal;                ///< unit, out of b towards a
    double gap;                            ///< [m], negative where they overlap
    double normal_impulse;                 ///< on a along the normal, and on b against it [N s]
    Eigen::Vector3d friction_impulse;      ///< on a, across the normal [N s]
    double normal_force;                   ///< the same as means over the step [N]
    Eigen::Vector3d friction_force;
    double approach_speed;  ///< greatest at the start of a substep in which it pushed [m/s]
    bool touches;           ///< it pushed in the last substep, or the surfaces are not apart

    Eigen::Vector3d impulse() const { return normal_impulse * normal + friction_impulse; }
    Eigen::Vector3d force() const { return normal_force * normal + friction_force; }
};

/// A point at which a particle touches a body, or nearly does. Points near surfaces that deform
/// (World::surface_contacts) are not among them.
struct ParticleContact {
    std::uint32_t particle, body;          ///< particle: index into Frame::particles
    std::uint32_t deformable;              ///< of which the particle is a point
    std::uint32_t material_a, material_b;  ///< of the particle, of the body
    Eigen::Vector3d point_a, point_b;      ///< on the particle's surface, on the body's [m]
    Eigen::Vector3d normal;                ///< unit, out of the body
    double gap;                            ///< [m]
    double normal_impulse;                 ///< on the particle [N s]
    Eigen::Vector3d friction_impulse;      ///< on the particle [N s]
    double normal_force;                   ///< means over the step [N]
    Eigen::Vector3d friction_force;
};

/// What happened to a pair of bodies in the last step. Of one pair there may be several.
struct ContactEvent {
    enum class Kind : std::uint32_t {
        began,  ///< to touch
        hit,    ///< as hard as ContactWatch says, or harder; what does not bounce may be braked to
                ///< the surface in one step and stopped in the next, and then hits in both
        ended   ///< does not touch any more; perhaps it began in the same step
    };
    Kind kind;
    std::uint32_t body_a, body_b;  ///< body_a < body_b; where a touch ended, they may be removed
    double impulse;                ///< along the normals of all contacts of the pair [N s]
    double approach_speed;         ///< the greatest of them [m/s]
    Eigen::Vector3d point;         ///< half-way between the surfaces of the contact that bore most;
                                   ///< 0 where the pair has none any more [m]
};

/// What counts as a hit: either is enough.
struct ContactWatch {
    double least_impulse =
        std::numeric_limits<double>::infinity();  ///< of a pair in a step [N s]; what only rests
                                                  ///< bears its weight times the step, too
    double least_speed = std::numeric_limits<double>::infinity();  ///< of approach [m/s]
};

}  // namespace plumb
