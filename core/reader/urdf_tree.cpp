// SPDX-License-Identifier: MIT
#include "reader/urdf_tree.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "math/principal.h"
#include "reader/types.h"
#include "scene/nearest.h"

namespace plumb::reader {

namespace {

/// Throws unless a link's inertial element is possible; a mass of 0 is, with no inertia.
void check_inertial(const urdf::Link& link) {
    const urdf::Inertial& i = *link.inertial;
    if (!(i.mass == 0 || (i.mass >= kMass.low && i.mass <= kMass.high)))
        throw BadRobot(link_named(link.name) + ": its mass must be 0, or " +
                       in_words(kMass, "a number"));
    if (!(to_eigen(i.origin.position).cwiseAbs().maxCoeff() <= kLength.high))
        throw BadRobot(link_named(link.name) + ": its centre of mass is too far away");
}

Eigen::Matrix3d tensor_of(const urdf::Inertial& i) {
    Eigen::Matrix3d tensor;
    tensor << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
    return tensor;
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
    Positions(const urdf::ModelInterface& model, std::map<std::string, double> known)
        : model_(model), known_(std::move(known)) {}

    double of(const urdf::Joint& joint) {
        if (const auto found = known_.find(joint.name); found != known_.end()) return found->second;
        if (!open_.insert(joint.name).second)
            throw BadRobot(joint_named(joint.name) + " mimics itself, through others");
        const urdf::JointMimic& mimic = *joint.mimic;
        const auto other = model_.joints_.find(mimic.joint_name);
        if (other == model_.joints_.end() || !has_coordinate(*other->second)) {
            throw BadRobot(joint_named(joint.name) + " mimics \"" + mimic.joint_name +
                           "\", which is no joint that turns or slides");
        }
        const double position = mimic.multiplier * of(*other->second) + mimic.offset;
        known_[joint.name] = position;
        return position;
    }

    const std::map<std::string, double>& all() const { return known_; }

private:
    const urdf::ModelInterface& model_;
    std::map<std::string, double> known_;
    std::set<std::string> open_;
};

void check_limits(const urdf::Joint& joint) {
    const urdf::JointLimits& limits = *joint.limits;
    if (limits.lower > limits.upper)
        throw BadRobot(joint_named(joint.name) + ": its lower limit is above the upper one");
}

double given_position(const urdf::Joint& joint, double position) {
    if (joint.mimic)
        throw BadRobot(joint_named(joint.name) + " mimics \"" + joint.mimic->joint_name +
                       "\", so its position cannot be chosen");
    constexpr double rounding = 1e-9;
    if (has_limits(joint) &&
        (position < joint.limits->lower - rounding || position > joint.limits->upper + rounding)) {
        throw BadRobot(joint_named(joint.name) + " cannot start at " + std::to_string(position) +
                       ": its limits are " + std::to_string(joint.limits->lower) + " and " +
                       std::to_string(joint.limits->upper));
    }
    return position;
}

double default_position(const urdf::Joint& joint, std::vector<std::string>& remarks) {
    if (!has_limits(joint)) return 0;
    const double position = std::clamp(0.0, joint.limits->lower, joint.limits->upper);
    if (position != 0)
        remarks.push_back(joint_named(joint.name) + " starts at " + std::to_string(position) +
                          ", for 0 is beyond its limits");
    if (joint.limits->lower == joint.limits->upper)
        remarks.push_back(joint_named(joint.name) + " cannot move: its limits are the same");
    return position;
}

/// Throws for names that are of no joint with a coordinate.
void check_names(const urdf::ModelInterface& model, const std::map<std::string, double>& given) {
    std::vector<std::string> names;
    for (const auto& [name, joint] : model.joints_) {
        if (has_coordinate(*joint)) names.push_back(name);
    }
    for (const auto& entry : given) {
        const auto found = model.joints_.find(entry.first);
        if (found == model.joints_.end())
            throw BadRobot("there is no " + joint_named(entry.first) + advice(entry.first, names));
        if (!has_coordinate(*found->second))
            throw BadRobot(joint_named(entry.first) + " neither turns nor slides along one axis");
    }
}

Placement motion(const urdf::Joint& joint, double position) {
    if (is_prismatic(joint)) return {position * axis_of(joint), Eigen::Quaterniond::Identity()};
    return {Eigen::Vector3d::Zero(),
            Eigen::Quaterniond(Eigen::AngleAxisd(position, axis_of(joint)))};
}

}  // namespace

Eigen::Vector3d to_eigen(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Placement to_placement(const urdf::Pose& pose) {
    const urdf::Rotation& r = pose.rotation;
    return {to_eigen(pose.position), Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized()};
}

bool has_coordinate(const urdf::Joint& joint) {
    return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS ||
           joint.type == urdf::Joint::PRISMATIC;
}

bool is_prismatic(const urdf::Joint& joint) { return joint.type == urdf::Joint::PRISMATIC; }

bool has_limits(const urdf::Joint& joint) {
    return joint.limits &&
           (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::PRISMATIC);
}

Eigen::Vector3d axis_of(const urdf::Joint& joint) {
    const Eigen::Vector3d axis = to_eigen(joint.axis);
    if (!(axis.norm() > 1e-9))
        throw BadRobot(joint_named(joint.name) + ": its axis is zero, so it has no direction");
    if (!(axis.norm() < 1e9)) throw BadRobot(joint_named(joint.name) + ": its axis is too long");
    return axis.normalized();
}

std::vector<LinkGroup> link_groups(const urdf::ModelInterface& model) {
    std::vector<LinkGroup> groups(1);
    struct Open {
        const urdf::Link* link;
        std::uint32_t group;
        Placement in_group;
    };
    std::vector<Open> open{{model.root_link_.get(), 0, {}}};
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        groups[next.group].links.push_back({next.link, next.in_group});
        const auto& joints = next.link->child_joints;
        for (std::size_t i = joints.size(); i-- > 0;) {
            const urdf::Link* child = next.link->child_links[i].get();
            const Placement joint =
                next.in_group * to_placement(joints[i]->parent_to_joint_origin_transform);
            if (joints[i]->type == urdf::Joint::FIXED) {
                open.push_back({child, next.group, joint});
                continue;
            }
            open.push_back({child, static_cast<std::uint32_t>(groups.size()), {}});
            groups.push_back({{}, next.group, joints[i].get(), joint, {}});
        }
    }
    return groups;
}

std::map<std::string, double> start_positions(const urdf::ModelInterface& model,
                                              const std::map<std::string, double>& given,
                                              std::vector<std::string>& remarks) {
    check_names(model, given);
    std::map<std::string, double> known;
    for (const auto& [name, joint] : model.joints_) {
        if (!has_coordinate(*joint)) continue;
        if (has_limits(*joint)) check_limits(*joint);
        if (const auto found = given.find(name); found != given.end())
            known[name] = given_position(*joint, found->second);
        else if (!joint->mimic)
            known[name] = default_position(*joint, remarks);
    }
    Positions positions(model, std::move(known));
    for (const auto& [name, joint] : model.joints_) {
        if (has_coordinate(*joint)) positions.of(*joint);
    }
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
        if (has_coordinate(*group.joint))
            group.world = group.world * motion(*group.joint, positions.at(group.joint->name));
    }
}

double mass_of(const LinkGroup& group) {
    double sum = 0;
    for (const GroupedLink& part : group.links) {
        if (!part.link->inertial) continue;
        check_inertial(*part.link);
        sum += part.link->inertial->mass;
    }
    return sum;
}

MovingMass moving_mass_of(const LinkGroup& group) {
    MovingMass sum{mass_of(group), Eigen::Vector3d::Zero(), {}};
    if (sum.mass == 0) throw BadRobot(link_named(group.name()) + " has no mass, so it cannot move");
    for (const auto& [link, in_group] : group.links) {
        if (!link->inertial) continue;
        sum.frame.position += link->inertial->mass / sum.mass *
                              (in_group * to_placement(link->inertial->origin)).position;
    }

    // Each about its own centre, then by Steiner about the common one.
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    for (const auto& [link, in_group] : group.links) {
        if (!link->inertial) continue;
        const Placement own = in_group * to_placement(link->inertial->origin);
        const Eigen::Matrix3d r = own.rotation.toRotationMatrix();
        const Eigen::Vector3d d = own.position - sum.frame.position;
        tensor += r * tensor_of(*link->inertial) * r.transpose() +
                  link->inertial->mass *
                      (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
    }
    const Principal principal = principal_axes(tensor);
    check_moments(group, principal.moments);
    sum.moments = principal.moments, sum.frame.rotation = principal.axes;
    return sum;
}

}  // namespace plumb::reader
