// SPDX-License-Identifier: MIT
/// What is made of particles (§7): ropes, cloth, balloons and solids, and what ties their points to
/// bodies, to the world and to each other.
///
/// Materials are given by the numbers of a data sheet, and what they come to does not depend on how
/// finely a shape is divided. Points are in the world frame, as they are at the start, which is
/// also the shape without strain.
#pragma once

#include "scene/geometry.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

enum class DeformableKind : std::uint32_t { rope, cloth, balloon, solid };

struct Elasticity {
    double youngs_modulus = 1e6;  ///< [Pa]
    double poissons_ratio = 0.3;  ///< in (−1, 0.5) of solids, (−1, 1) of cloth and balloons
    double damping = 0;           ///< stress of a strain rate, over the modulus [s]
    std::optional<double> bending_stiffness;  ///< of cloth and balloons [N m], of ropes [N m²];
                                              ///< else from the modulus and the thickness
};

struct DeformableSpec {
    std::string name;
    DeformableKind kind = DeformableKind::cloth;
    std::vector<Eigen::Vector3d> points;                   ///< [m]
    std::vector<std::array<std::uint32_t, 2>> segments;    ///< of a rope
    std::vector<std::array<std::uint32_t, 3>> triangles;   ///< of cloth and balloons; of a solid
                                                           ///< its surface, or none: it is found
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< of a solid
    std::uint32_t material = 0;                            ///< index into Scene::materials
    double thickness = 0.001;                              ///< of cloth; a rope's diameter [m]
    std::optional<double> mass;                            ///< whole [kg]; else density × volume
    Elasticity elasticity;
    double volume_ratio = 1;         ///< k: a balloon keeps k times the volume of its points
    std::optional<double> pressure;  ///< over that outside [Pa], in place of a kept volume
    double drag = 1.2;               ///< coefficient of a plate across the wind
    double skin_drag = 0.01;         ///< coefficient of each side of a plate along the wind
    double radius = 0.005;           ///< of the particles, for contacts [m]
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
    double tearing_strain = std::numeric_limits<double>::infinity();
    std::uint32_t group = 1;  ///< collides if (group_a & mask_b) and (group_b & mask_a)
    std::uint32_t mask = ~0u;
    std::uint32_t color = 0;  ///< 0xRRGGBB, 0 = chosen by the viewer
};

/// A point of the world, of a body, or of a deformable.
struct ScenePoint {
    std::uint32_t deformable = kNoIndex;  ///< index into Scene::deformables
    std::uint32_t point = 0;              ///< of it
    std::uint32_t body = kNoIndex;        ///< index into Scene::bodies, where it is on a body
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< at the start, unless it is of a
                                                         ///< deformable; world frame [m]
};

/// A rod or a rope between any two points.
struct LinkSpec {
    ScenePoint a, b;
    std::optional<double> shortest, longest;  ///< [m]; neither: as far apart as at the start
    double compliance = 0;                    ///< [m/N]
    double damping = 0;                       ///< [N s/m]
};

/// Points of a deformable that ride on a body, or stay where they are in the world.
struct AttachmentSpec {
    std::uint32_t deformable = 0;       ///< index into Scene::deformables
    std::vector<std::uint32_t> points;  ///< of it
    std::uint32_t body = kNoIndex;      ///< index into Scene::bodies; kNoIndex: the world
    double compliance = 0;              ///< [m/N]
};

}  // namespace plumb
