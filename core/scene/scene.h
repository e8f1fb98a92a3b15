// SPDX-License-Identifier: MIT
/// A scene: what the user wrote, as plain values. SI units, y up by default, world frame.
///
/// The reader fills it from JSON; a program may fill it by hand. Nothing here is checked:
/// `build_world` checks.
#pragma once

#include "scene/deformable.h"
#include "scene/geometry.h"
#include "scene/joint.h"
#include "scene/settings.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

struct Material {
    std::string name = "default";
    double density = 1000;         ///< [kg/m³]
    double friction = 0.5;         ///< Coulomb's coefficient
    double restitution = 0;        ///< in [0, 1]
    double rolling_friction = 0;   ///< lever of the resisting torque [m]
    double spinning_friction = 0;  ///< lever of the torque about the normal [m]
};

/// Overrides of the rules of combination (friction √(μ_a μ_b), restitution max) for one pair of
/// materials.
struct MaterialPair {
    std::uint32_t a = 0, b = 0;  ///< indices into Scene::materials
    std::optional<double> friction, restitution, rolling_friction, spinning_friction;
};

/// `asleep` is the state of a dynamic body that rests (Settings::sleep_speed); no scene begins so.
enum class Motion : std::uint32_t { fixed, kinematic, dynamic, asleep };

/// Where a kinematic body is at a time; between keyframes position is linear and rotation turns
/// evenly.
struct Keyframe {
    double time = 0;  ///< [s]
    Placement placement;
};

/// Motion of a kinematic body: keyframes, repeated when `loop` is set; without keyframes its
/// constant velocities.
struct MotionScript {
    std::vector<Keyframe> keyframes;
    bool loop = false;
};

struct BodySpec {
    std::string name;
    Motion motion = Motion::dynamic;
    std::uint32_t geometry =
        kNoIndex;  ///< index into Scene::geometries; kNoIndex: no shape, mass and inertia required
    std::uint32_t material = 0;                          ///< index into Scene::materials
    Placement placement;                                 ///< of the geometry's frame at the start
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the centre of mass [m/s]
    Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< [rad/s]
    std::optional<double> mass;                                  ///< [kg]; else density × volume
    std::optional<Eigen::Vector3d>
        inertia;  ///< principal moments in the geometry's frame [kg m²]; else from the shape
    std::optional<Placement> mass_frame;  ///< centre of mass and axes of `inertia` in the
                                          ///< geometry's frame; needs mass and inertia
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< constant, at the centre of mass [N]
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< constant [N m]
    std::uint32_t group = 1;  ///< collides if (group_a & mask_b) and (group_b & mask_a)
    std::uint32_t mask = ~0u;
    MotionScript script;      ///< kinematic bodies only
    std::uint32_t color = 0;  ///< 0xRRGGBB, 0 = chosen by the viewer
};

/// Where the picture is taken from.
struct View {
    Eigen::Vector3d eye{9, 6, 12};      ///< [m]
    Eigen::Vector3d target{0, 1.5, 0};  ///< [m]
    double field_of_view = 40;          ///< vertical [degrees]
};

struct Scene {
    std::string name = "scene";
    std::string description;
    Settings settings;
    std::vector<Material> materials{Material{}};
    std::vector<MaterialPair> material_pairs;
    std::vector<Geometry> geometries;
    std::vector<BodySpec> bodies;
    std::vector<JointSpec> joints;
    std::vector<CouplingSpec> couplings;
    std::vector<DeformableSpec> deformables;
    std::vector<LinkSpec> links;
    std::vector<AttachmentSpec> attachments;
    std::vector<std::array<std::uint32_t, 2>> apart;  ///< bodies that never collide with each other
    std::vector<std::string> remarks;  ///< what a reader left out or changed, in sentences
    std::optional<View> view;
};

}  // namespace plumb
