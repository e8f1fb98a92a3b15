// SPDX-License-Identifier: MIT
#include "reader/robots/tree.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "math/principal.h"
#include "reader/json/types.h"
#include "scene/nearest.h"

namespace plumb::reader {

namespace {

constexpr std::size_t kMostLinks = 10'000;

/// Throws unless what a link weighs is possible; a mass of 0 is, with no inertia.
void check_inertia(const RobotLink& link) {
    const RobotInertia& i = *link.inertia;
    if (!(i.mass == 0 || (i.mass >= kMass.low && i.mass <= kMass.high)))
        throw BadRobot(link_named(link.name) + ": its mass must be 0, or " +
                       in_words(kMass, "a number"));
    if (!(i.frame.position.cwiseAbs().maxCoeff() <= kLength.high))
        throw BadRobot(link_named(link.name) + ": its centre of mass is too far away");
}

/// Throws unless `moments` are those of a body.
void check_moments(const LinkGroup& group, const Eigen::Vector3d& moments) {
    const std::string about = link_named(group.name()) + ": its inertia ";
    if (!(moments.maxCoeff() <= kMass.high) || !(moments.minCoeff() > 1e-12 * moments.maxCoeff()))
        throw BadRobot(about + "is missing or not positive, so it cannot move");
    if (2 * moments.maxCoeff() > moments.sum() * (1 + 1e-6)) {
        throw BadRobot(about +
                       "is of no body: its greatest principal moment is more than the other two "
                       "together");
    }
}

/// The coordinate of a joint that mimics another, once that one's is known.
class Positions {
public:
    Positions(const RobotDescription& robot, std::map<std::string, double> known)
        : robot_(robot), known_(std::move(known)) {}

    double of(const RobotJoint& joint) {
        if (const auto found = known_.find(joint.name); found != known_.end()) return found->second;
        if (!open_.insert(joint.name).second)
            throw BadRobot(joint_named(joint.name) + " mimics itself, through others");
        const RobotMimic& mimic = *joint.mimic;
        const RobotJoint* other = robot_.find_joint(mimic.joint);
        if (!other || !other->has_coordinate()) {
            throw BadRobot(joint_named(joint.name) + " mimics \"" + mimic.joint +
                           "\", which is no joint that turns or slides");
        }
        const double position = mimic.multiplier * of(*other) + mimic.offset;
        known_[joint.name] = position;
        return position;
    }

    const std::map<std::string, double>& all() const { return known_; }

private:
    const RobotDescription& robot_;
    std::map<std::string, double> known_;
    std::set<std::string> open_;
};

void check_limits(const RobotJoint& joint) {
    if (!(joint.limits->lower <= joint.limits->upper))
        throw BadRobot(joint_named(joint.name) + ": its lower limit is above the upper one");
}

double given_position(const RobotJoint& joint, double position) {
    if (joint.mimic)
        throw BadRobot(joint_named(joint.name) + " mimics \"" + joint.mimic->joint +
                       "\", so its position cannot be chosen");
    constexpr double rounding = 1e-9;
    if (joint.limits &&
        (position < joint.limits->lower - rounding || position > joint.limits->upper + rounding)) {
        throw BadRobot(joint_named(joint.name) + " cannot start at " + std::to_string(position) +
                       ": its limits are " + std::to_string(joint.limits->lower) + " and " +
                       std::to_string(joint.limits->upper));
    }
    return position;
}

double default_position(const RobotJoint& joint, std::vector<std::string>& remarks) {
    if (!joint.limits) return 0;
    const double position = std::clamp(0.0, joint.limits->lower, joint.limits->upper);
    if (position != 0)
        remarks.push_back(joint_named(joint.name) + " starts at " + std::to_string(position) +
                          ", for 0 is beyond its limits");
    if (joint.limits->lower == joint.limits->upper)
        remarks.push_back(joint_named(joint.name) + " cannot move: its limits are the same");
    return position;
}

/// Throws for names that are of no joint with a coordinate.
void check_names(const RobotDescription& robot, const std::map<std::string, double>& given) {
    for (const auto& entry : given)
        if (!known_joint(robot, entry.first).has_coordinate())
            throw BadRobot(joint_named(entry.first) + " neither turns nor slides along one axis");
}

Placement motion(const RobotJoint& joint, double position) {
    if (joint.is_slider()) return {position * axis_of(joint), Eigen::Quaterniond::Identity()};
    return {Eigen::Vector3d::Zero(),
            Eigen::Quaterniond(Eigen::AngleAxisd(position, axis_of(joint)))};
}

void check_tree(const RobotDescription& robot) {
    const std::size_t links = robot.links.size(), joints = robot.joints.size();
    if (links > kMostLinks)
        throw BadRobot("it has more than " + std::to_string(kMostLinks) + " links");
    if (robot.root >= links) throw BadRobot("it has no root link");
    std::set<std::string> names;
    for (const RobotLink& link : robot.links)
        if (!names.insert(link.name).second)
            throw BadRobot("there are two of the name " + link_named(link.name));
    names.clear();
    for (const RobotJoint& joint : robot.joints)
        if (!names.insert(joint.name).second)
            throw BadRobot("there are two of the name " + joint_named(joint.name));
    std::vector<const RobotJoint*> parent(links, nullptr);
    for (const RobotJoint& joint : robot.joints) {
        if (joint.child >= links) throw BadRobot(joint_named(joint.name) + " has no child link");
        if (const RobotJoint*& other = parent[joint.child]; !other)
            other = &joint;
        else
            throw BadRobot(link_named(robot.links[joint.child].name) +
                           " is the child of two joints, \"" + other->name + "\" and \"" +
                           joint.name + "\"; a robot is a tree");
    }

    const std::string& root = robot.links[robot.root].name;
    if (parent[robot.root])
        throw BadRobot(link_named(root) + ", the root, hangs on " +
                       joint_named(parent[robot.root]->name));
    std::vector<std::uint8_t> reached(links, 0);
    std::vector<std::uint32_t> open{robot.root};
    while (!open.empty()) {
        const std::uint32_t link = open.back();
        open.pop_back();
        if (reached[link]++)
            throw BadRobot(link_named(robot.links[link].name) + " hangs twice on one joint");
        for (const std::uint32_t joint : robot.links[link].joints) {
            if (joint >= joints)
                throw BadRobot(link_named(robot.links[link].name) + " carries an unknown joint");
            open.push_back(robot.joints[joint].child);
        }
    }
    for (std::size_t i = 0; i < links; ++i)
        if (!reached[i])
            throw BadRobot(link_named(robot.links[i].name) +
                           " is in a ring of joints, or on none, so that the root, \"" + root +
                           "\", does not reach it; a robot is a tree");
}

}  // namespace

const RobotJoint& known_joint(const RobotDescription& robot, const std::string& name) {
    if (const RobotJoint* found = robot.find_joint(name)) return *found;
    std::vector<std::string> names;
    for (const RobotJoint& joint : robot.joints)
        if (joint.has_coordinate()) names.push_back(joint.name);
    throw BadRobot("there is no " + joint_named(name) + advice(name, names));
}

Eigen::Vector3d axis_of(const RobotJoint& joint) {
    const Eigen::Vector3d& axis = joint.axis;
    if (!(axis.norm() > 1e-9))
        throw BadRobot(joint_named(joint.name) + ": its axis is zero, so it has no direction");
    if (!(axis.norm() < 1e9)) throw BadRobot(joint_named(joint.name) + ": its axis is too long");
    return axis.normalized();
}

std::vector<LinkGroup> link_groups(const RobotDescription& robot) {
    check_tree(robot);
    std::vector<LinkGroup> groups(1);
    struct Open {
        std::uint32_t link, group;
        Placement in_group;
    };
    std::vector<Open> open{{robot.root, 0, {}}};
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        const RobotLink& link = robot.links[next.link];
        groups[next.group].links.push_back({&link, next.in_group});
        for (auto i = link.joints.rbegin(); i != link.joints.rend(); ++i) {
            const RobotJoint& joint = robot.joints[*i];
            const Placement at = next.in_group * joint.in_parent;
            if (joint.kind == RobotJointKind::fixed) {
                open.push_back({joint.child, next.group, at});
                continue;
            }
            open.push_back({joint.child, static_cast<std::uint32_t>(groups.size()), {}});
            groups.push_back({{}, next.group, &joint, at, {}});
        }
    }
    return groups;
}

std::map<std::string, double> start_positions(const RobotDescription& robot,
                                              const std::map<std::string, double>& given,
                                              std::vector<std::string>& remarks) {
    check_names(robot, given);
    std::map<std::string, double> known;
    for (const RobotJoint& joint : robot.joints) {
        if (!joint.has_coordinate()) continue;
        if (joint.limits) check_limits(joint);
        if (const auto found = given.find(joint.name); found != given.end())
            known[joint.name] = given_position(joint, found->second);
        else if (!joint.mimic)
            known[joint.name] = default_position(joint, remarks);
    }
    Positions positions(robot, std::move(known));
    for (const RobotJoint& joint : robot.joints)
        if (joint.has_coordinate()) positions.of(joint);
    return positions.all();
}

void place(std::vector<LinkGroup>& groups, const Placement& root,
           const std::map<std::string, double>& positions) {
    for (LinkGroup& group : groups) {
        if (!group.joint) {
            group.world = root;
            continue;
        }
        group.world = groups[group.parent].world * group.joint_in_parent;
        if (group.joint->has_coordinate())
            group.world = group.world * motion(*group.joint, positions.at(group.joint->name));
    }
}

double mass_of(const LinkGroup& group) {
    double sum = 0;
    for (const GroupedLink& part : group.links) {
        if (!part.link->inertia) continue;
        check_inertia(*part.link);
        sum += part.link->inertia->mass;
    }
    return sum;
}

MovingMass moving_mass_of(const LinkGroup& group) {
    MovingMass sum{mass_of(group), Eigen::Vector3d::Zero(), {}};
    if (sum.mass == 0) throw BadRobot(link_named(group.name()) + " has no mass, so it cannot move");
    for (const auto& [link, in_group] : group.links)
        if (link->inertia)
            sum.frame.position +=
                link->inertia->mass / sum.mass * (in_group * link->inertia->frame).position;

    // Each about its own centre, then by Steiner about the common one.
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    for (const auto& [link, in_group] : group.links) {
        if (!link->inertia) continue;
        const Placement own = in_group * link->inertia->frame;
        const Eigen::Matrix3d r = own.rotation.toRotationMatrix();
        const Eigen::Vector3d d = own.position - sum.frame.position;
        tensor += r * link->inertia->tensor * r.transpose() +
                  link->inertia->mass *
                      (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
    }
    const Principal principal = principal_axes(tensor);
    check_moments(group, principal.moments);
    sum.moments = principal.moments, sum.frame.rotation = principal.axes;
    return sum;
}

}  // namespace plumb::reader
