// SPDX-License-Identifier: MIT
/// What a robot is, whichever format its file has: a tree of links and joints in numbers of
/// Plumb's. Frames are those of the links; z points up. A format is a function that makes one of
/// these (robots/formats.h); what becomes of it knows no format.
#pragma once

#include "scene/scene.h"

#include <Eigen/Core>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace plumb {

struct RobotInertia {
    double mass = 0;  ///< [kg]
    Eigen::Matrix3d tensor =
        Eigen::Matrix3d::Zero();  ///< about the centre of mass, in the axes of `frame` [kg m²]
    Placement frame;              ///< its origin is the centre of mass
};

/// A file of triangles: a path, or a URI that begins with file:// or package://.
struct RobotMesh {
    std::string uri;
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
};

/// What collides: a sphere, a box, a cylinder about y, a hull, or a mesh.
struct RobotShape {
    Placement placement;
    std::variant<Geometry, RobotMesh> geometry;
};

struct RobotLink {
    std::string name;
    std::optional<RobotInertia> inertia;
    std::vector<RobotShape> shapes;
    std::vector<std::uint32_t> joints;  ///< by which other links hang on it
};

enum class RobotJointKind : std::uint32_t { fixed, hinge, slider, planar, floating };

struct RobotLimits {
    double lower, upper;  ///< [rad], [m]
};

/// q = multiplier × that of another joint + offset.
struct RobotMimic {
    std::string joint;
    double multiplier = 1, offset = 0;
};

/// Its frame is that of the child where the coordinate is 0.
struct RobotJoint {
    std::string name;
    RobotJointKind kind = RobotJointKind::fixed;
    std::uint32_t child = kNoIndex;  ///< link
    Placement in_parent;             ///< of the joint's frame
    Eigen::Vector3d axis =
        Eigen::Vector3d::UnitX();  ///< of a hinge, a slider; normal of a plane; any length
    std::optional<RobotLimits> limits;
    std::optional<double> greatest_effort, greatest_speed;  ///< [N m], [N]; [rad/s], [m/s]
    double damping = 0, friction = 0;                       ///< [N m s/rad], [N s/m]; [N m], [N]
    std::optional<RobotMimic> mimic;

    bool is_slider() const { return kind == RobotJointKind::slider; }
    /// Whether one number says how it stands.
    bool has_coordinate() const { return is_slider() || kind == RobotJointKind::hinge; }
};

struct RobotDescription {
    std::string name;  ///< may be empty
    std::vector<RobotLink> links;
    std::vector<RobotJoint> joints;
    std::uint32_t root = 0;  ///< the link that hangs on none

    /// None where there is no such joint.
    const RobotJoint* find_joint(const std::string& joint) const {
        for (const RobotJoint& j : joints)
            if (j.name == joint) return &j;
        return nullptr;
    }
};

namespace reader {

/// A robot description that cannot be used; `what()` is one sentence without the file's name.
class BadRobot : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

inline std::string link_named(const std::string& name) { return "link \"" + name + "\""; }
inline std::string joint_named(const std::string& name) { return "joint \"" + name + "\""; }

}  // namespace reader
}  // namespace plumb
