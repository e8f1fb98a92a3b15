// SPDX-License-Identifier: MIT
/// A robot's links, those that fixed joints tie put together, and where they are at the start.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reader/urdf_file.h"
#include "scene/scene.h"

namespace plumb::reader {

Eigen::Vector3d to_eigen(const urdf::Vector3& v);
Placement to_placement(const urdf::Pose& pose);

/// A link and its place in the frame of the first link of its group.
struct GroupedLink {
    const urdf::Link* link;
    Placement in_group;
};

/// Links that move as one. The frame of the first is the group's.
struct LinkGroup {
    std::vector<GroupedLink> links;
    std::uint32_t parent = kNoIndex;     ///< group that `joint` ties this one to
    const urdf::Joint* joint = nullptr;  ///< the root has none
    Placement joint_in_parent;           ///< of the joint's frame in the parent's, at coordinate 0
    Placement world;                     ///< at the start

    const std::string& name() const { return links.front().link->name; }
};

/// All groups, parents before children.
std::vector<LinkGroup> link_groups(const urdf::ModelInterface& model);

/// Whether a joint has one coordinate: revolute, continuous and prismatic ones do.
bool has_coordinate(const urdf::Joint& joint);
bool is_prismatic(const urdf::Joint& joint);
bool has_limits(const urdf::Joint& joint);

/// The unit axis of a joint, in its frame.
Eigen::Vector3d axis_of(const urdf::Joint& joint);

/// The coordinate at the start of every joint that has one [rad], [m]. Where `given` has none, it
/// is 0, or the limit that is nearest to 0; a mimic's follows from its joint's. Throws BadRobot.
std::map<std::string, double> start_positions(const urdf::ModelInterface& model,
                                              const std::map<std::string, double>& given,
                                              std::vector<std::string>& remarks);

/// Sets `world` of all groups, from where the root is.
void place(std::vector<LinkGroup>& groups, const Placement& root,
           const std::map<std::string, double>& positions);

/// The sum of a group's masses [kg]. Throws BadRobot for a negative one.
double mass_of(const LinkGroup& group);

/// Mass, centre of mass and principal axes of a group, in its frame. Throws BadRobot unless they
/// are those of a body that can move.
struct MovingMass {
    double mass;              ///< [kg]
    Eigen::Vector3d moments;  ///< [kg m²]
    Placement frame;
};
MovingMass moving_mass_of(const LinkGroup& group);

}  // namespace plumb::reader
