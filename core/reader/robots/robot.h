// SPDX-License-Identifier: MIT
/// Robots from their files, of which URDF is read (robots/formats.h).
///
/// Links become bodies and joints joints; links that a fixed joint ties are one body. Shapes are
/// those that collide (a URDF's "collision" elements); what looks alone serves is not read. A
/// robot's z axis points up; in the scene it points along y. Links of a robot whose base is fixed
/// do not collide with fixed bodies that they begin in. What was left out or changed is told in
/// Scene::remarks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reader/robots/description.h"
#include "scene/error.h"
#include "scene/scene.h"

namespace plumb {

enum class RobotBase : std::uint32_t {
    by_mass,  ///< free where the root link has a mass, else fixed
    fixed,
    free
};

/// What drives one of a robot's joints; targets are counted as its file counts.
struct RobotMotor {
    MotorMode mode = MotorMode::position;
    double target = 0;               ///< [rad], [m]; [rad/s], [m/s]
    std::optional<double> greatest;  ///< [N m], [N]; else the joint's limit of effort
    double frequency = 5;            ///< of a position motor: of the heavier side of the joint,
                                     ///< all other joints stiff [Hz]
    double damping_ratio = 1;
};

struct RobotOptions {
    std::string name;     ///< "NAME/LINK" is a body, "NAME/JOINT" a joint; empty: the robot's own
    Placement placement;  ///< of the root link; turned by nothing, its z axis points along y
    RobotBase base = RobotBase::by_mass;
    std::uint32_t material = 0;   ///< index into Scene::materials
    bool meshes_required = true;  ///< else collision meshes that cannot be had are left out
    bool decompose = false;       ///< meshes become several hulls instead of one
    bool self_collision = true;   ///< links collide with each other, but for those that a
                                  ///< joint ties and those that overlap at the start
    bool hold = false;            ///< every joint without a motor is held where it starts
    std::map<std::string, double> positions;   ///< at the start, by joint [rad], [m]; else 0, or
                                               ///< the limit that is nearest to it
    std::map<std::string, RobotMotor> motors;  ///< by joint
};

/// Where a robot's links and joints went.
struct Robot {
    std::string name;
    std::vector<std::pair<std::string, std::uint32_t>>
        links;  ///< "NAME/LINK" and its body, which links tied by fixed joints share; those that
                ///< are fixed and have no shape are part of the world, and not among them
    std::vector<std::pair<std::string, std::uint32_t>> joints;  ///< "NAME/JOINT"
};

/// Adds a robot to a scene. Throws SceneError, with the file and the name of the link or joint.
///
/// A joint's coordinate is counted from where it starts, for a joint's frames coincide then: the
/// file's limits and the motors' targets are shifted accordingly.
Robot add_robot(Scene& scene, const std::filesystem::path& file, const RobotOptions& options);
/// The same of one that is no file, or of no format known here. `file`: its folder is where meshes
/// are looked for, its name stands in errors and remarks.
Robot add_robot(Scene& scene, RobotDescription description, const std::filesystem::path& file,
                const RobotOptions& options);

/// A scene of one robot, whose lowest point stands on the ground, a plane at y = 0. The position of
/// the options is added to that. Steps of 5 ms, with a leapfrog start.
Scene read_robot(const std::filesystem::path& file, const RobotOptions& options = {});

}  // namespace plumb
