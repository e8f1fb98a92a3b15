// SPDX-License-Identifier: MIT
#include "reader/robots/urdf.h"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>
#include <urdf_world/types.h>

#include <exception>
#include <map>
#include <mutex>
#include <numbers>
#include <set>
#include <string_view>
#include <vector>

#include "reader/meshes/file_text.h"
#include "scene/build.h"

namespace plumb::reader {

namespace {

constexpr int kDeepest = 100;  // elements within elements; the parser calls itself for each

/// Collects what urdfdom would print, for as long as it lives.
class Listener : public console_bridge::OutputHandler {
public:
    Listener()
        : before_(console_bridge::getOutputHandler()), level_(console_bridge::getLogLevel()) {
        console_bridge::useOutputHandler(this);
        console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_ERROR);
    }
    ~Listener() override {
        console_bridge::setLogLevel(level_);
        console_bridge::useOutputHandler(before_);
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
        // The last word of a failure, which says nothing that was not said before.
        const bool empty = text.find("xml is not initialized correctly") != std::string::npos;
        if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR || (empty && !errors_.empty())) return;
        errors_ += (errors_.empty() ? "" : "; ") + text;
    }

    /// All errors in one sentence; "" where there are none.
    const std::string& errors() const { return errors_; }

private:
    console_bridge::OutputHandler* before_;
    console_bridge::LogLevel level_;
    std::string errors_;
};

/// How deep elements stand within each other; comments count as nothing.
int nesting(std::string_view text) {
    int depth = 0, deepest = 0;
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
        if (text.substr(at, 4) == "<!--") {
            at = std::min(text.find("-->", at), text.size());
            continue;
        }
        const std::size_t end = std::min(text.find('>', at), text.size());
        const char first = at + 1 < text.size() ? text[at + 1] : ' ';
        if (first == '/') {
            --depth;
        } else if (first != '!' && first != '?' && text[end - 1] != '/') {
            deepest = std::max(deepest, ++depth);
        }
        at = end;
    }
    return deepest;
}

void keep_only(TiXmlElement& parent, const std::set<std::string>& names) {
    for (TiXmlNode* child = parent.FirstChild(); child;) {
        TiXmlNode* next = child->NextSibling();
        if (!child->ToElement() || !names.contains(child->ValueStr())) parent.RemoveChild(child);
        child = next;
    }
}

/// The text with nothing but what a simulation needs. Throws what is wrong, as a sentence.
std::string essence(const std::string& text) {
    if (nesting(text) > kDeepest) throw BadRobot("elements are nested too deeply");
    TiXmlDocument document;
    document.Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
    if (document.Error()) {
        std::string reason = document.ErrorDesc();
        while (reason.ends_with('.')) reason.pop_back();
        // There is no line where the text ends too early.
        const int row = document.ErrorRow();
        throw BadRobot((row > 0 ? "line " + std::to_string(row) + ": " : "") +
                       "not good XML: " + reason);
    }
    TiXmlElement* robot = document.FirstChildElement("robot");
    if (!robot) throw BadRobot("there is no \"robot\" element in it");
    keep_only(*robot, {"link", "joint"});
    for (TiXmlElement* e = robot->FirstChildElement(); e; e = e->NextSiblingElement()) {
        keep_only(*e, e->ValueStr() == "link"
                          ? std::set<std::string>{"inertial", "collision"}
                          : std::set<std::string>{"origin", "parent", "child", "axis", "limit",
                                                  "dynamics", "mimic"});
    }
    TiXmlPrinter printer;
    document.Accept(&printer);
    return printer.Str();
}

/// Throws what urdfdom complains of, in one sentence.
urdf::ModelInterfaceSharedPtr parse(const std::string& text) {
    static std::mutex one_at_a_time;  // the listener is the whole program's
    const std::lock_guard lock(one_at_a_time);
    const Listener listener;
    urdf::ModelInterfaceSharedPtr model;
    try {
        model = urdf::parseURDF(text);
    } catch (const std::exception& error) {
        throw BadRobot(std::string("not a good robot description: ") + error.what());
    }
    if (!listener.errors().empty()) throw BadRobot(listener.errors());
    if (!model) throw BadRobot("not a good robot description");
    return model;
}

Eigen::Vector3d to_eigen(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Placement to_placement(const urdf::Pose& pose) {
    const urdf::Rotation& r = pose.rotation;
    return {to_eigen(pose.position), Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized()};
}

RobotInertia inertia_of(const urdf::Inertial& i) {
    RobotInertia inertia{i.mass, {}, to_placement(i.origin)};
    inertia.tensor << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
    return inertia;
}

/// The axis of Plumb's cylinders, y, to that of a URDF's, z.
Eigen::Quaterniond y_to_z() {
    return Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()));
}

RobotShape shape_of(const urdf::Collision& collision) {
    RobotShape shape{to_placement(collision.origin), {}};
    const urdf::Geometry& g = *collision.geometry;
    switch (g.type) {
        case urdf::Geometry::BOX:
            shape.geometry = box(0.5 * to_eigen(static_cast<const urdf::Box&>(g).dim));
            break;
        case urdf::Geometry::SPHERE:
            shape.geometry = sphere(static_cast<const urdf::Sphere&>(g).radius);
            break;
        case urdf::Geometry::CYLINDER: {
            const auto& c = static_cast<const urdf::Cylinder&>(g);
            shape.geometry = cylinder(c.radius, c.length / 2);
            shape.placement.rotation = shape.placement.rotation * y_to_z();
            break;
        }
        case urdf::Geometry::MESH: {
            const auto& mesh = static_cast<const urdf::Mesh&>(g);
            shape.geometry = RobotMesh{mesh.filename, to_eigen(mesh.scale)};
            break;
        }
    }
    return shape;
}

RobotLink link_of(const urdf::Link& from) {
    RobotLink link{from.name, {}, {}, {}};
    if (from.inertial) link.inertia = inertia_of(*from.inertial);
    for (const auto& collision : from.collision_array) link.shapes.push_back(shape_of(*collision));
    return link;
}

RobotJointKind kind_of(const urdf::Joint& joint) {
    switch (joint.type) {
        case urdf::Joint::REVOLUTE:
        case urdf::Joint::CONTINUOUS:
            return RobotJointKind::hinge;
        case urdf::Joint::PRISMATIC:
            return RobotJointKind::slider;
        case urdf::Joint::PLANAR:
            return RobotJointKind::planar;
        case urdf::Joint::FLOATING:
            return RobotJointKind::floating;
        default:
            return RobotJointKind::fixed;
    }
}

RobotJoint joint_of(const urdf::Joint& from) {
    RobotJoint joint;
    joint.name = from.name, joint.kind = kind_of(from);
    joint.in_parent = to_placement(from.parent_to_joint_origin_transform);
    joint.axis = to_eigen(from.axis);
    if (from.limits) {
        if (from.type != urdf::Joint::CONTINUOUS)
            joint.limits = RobotLimits{from.limits->lower, from.limits->upper};
        joint.greatest_effort = from.limits->effort;
        if (from.limits->velocity != 0) joint.greatest_speed = from.limits->velocity;
    }
    if (from.dynamics)
        joint.damping = from.dynamics->damping, joint.friction = from.dynamics->friction;
    if (from.mimic)
        joint.mimic =
            RobotMimic{from.mimic->joint_name, from.mimic->multiplier, from.mimic->offset};
    return joint;
}

RobotDescription description_of(const urdf::ModelInterface& model) {
    RobotDescription robot;
    robot.name = model.getName();
    std::map<std::string, std::uint32_t> links, joints;
    for (const auto& [name, link] : model.links_) {
        links[name] = static_cast<std::uint32_t>(robot.links.size());
        robot.links.push_back(link_of(*link));
    }
    for (const auto& [name, joint] : model.joints_) {
        joints[name] = static_cast<std::uint32_t>(robot.joints.size());
        robot.joints.push_back(joint_of(*joint));
        robot.joints.back().child = links.at(joint->child_link_name);
    }
    for (const auto& [name, link] : model.links_)
        for (const auto& joint : link->child_joints)
            robot.links[links.at(name)].joints.push_back(joints.at(joint->name));
    robot.root = links.at(model.root_link_->name);
    return robot;
}

}  // namespace

RobotDescription load_urdf(const std::filesystem::path& file) {
    return description_of(*parse(essence(text_of_file(file))));
}

}  // namespace plumb::reader
