// SPDX-License-Identifier: MIT
/// A robot's links, those that fixed joints tie put together, and where they are at the start.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reader/robots/description.h"
#include "scene/scene.h"

namespace plumb::reader {

/// A link and its place in the frame of the first link of its group.
struct GroupedLink {
    const RobotLink* link;
    Placement in_group;
};

/// Links that move as one. The frame of the first is the group's.
struct LinkGroup {
    std::vector<GroupedLink> links;
    std::uint32_t parent = kNoIndex;    ///< group that `joint` ties this one to
    const RobotJoint* joint = nullptr;  ///< the root has none
    Placement joint_in_parent;          ///< of the joint's frame in the parent's, at coordinate 0
    Placement world;                    ///< at the start

    const std::string& name() const { return links.front().link->name; }
};

/// All groups, parents before children. `robot` outlives them. Throws BadRobot for what is no tree.
std::vector<LinkGroup> link_groups(const RobotDescription& robot);

/// Throws BadRobot, with the nearest spelling, where there is none of that name.
const RobotJoint& known_joint(const RobotDescription& robot, const std::string& name);

/// The unit axis of a joint, in its frame.
Eigen::Vector3d axis_of(const RobotJoint& joint);

/// The coordinate at the start of every joint that has one [rad], [m]. Where `given` has none, it
/// is 0, or the limit that is nearest to 0; a mimic's follows from its joint's. Throws BadRobot.
std::map<std::string, double> start_positions(const RobotDescription& robot,
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
