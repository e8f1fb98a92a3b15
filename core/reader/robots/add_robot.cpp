// SPDX-License-Identifier: MIT
#include "reader/robots/robot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "geometry/overlap.h"
#include "reader/json/types.h"
#include "reader/robots/formats.h"
#include "reader/robots/joints.h"
#include "reader/robots/loads.h"
#include "reader/robots/shapes.h"
#include "reader/robots/tree.h"
#include "scene/build.h"

namespace plumb {

namespace reader {
namespace {

/// A robot's z axis, which points up, to the scene's y axis.
Eigen::Quaterniond z_to_y() {
    return Eigen::Quaterniond(Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitX()));
}

class RobotBuilder {
public:
    RobotBuilder(Scene& scene, RobotDescription description, const std::filesystem::path& file,
                 const RobotOptions& options)
        : scene_(scene),
          options_(options),
          file_name_(file.filename().string()),
          description_(std::move(description)),
          groups_(link_groups(description_)) {
        collision_ = {file.parent_path(), options.meshes_required, options.decompose};
        robot_.name = !options.name.empty()        ? options.name
                      : !description_.name.empty() ? description_.name
                                                   : file.stem().string();
    }

    Robot build() {
        check_motors(description_, options_);
        starts_ = start_positions(description_, options_.positions, remarks_);
        place(groups_, options_.placement * Placement{Eigen::Vector3d::Zero(), z_to_y()}, starts_);
        const auto first_body = static_cast<std::uint32_t>(scene_.bodies.size());
        for (std::size_t i = 0; i < groups_.size(); ++i) add_body(groups_[i], i == 0);
        const std::vector<double> factors = frequency_factors(groups_, masses_);
        for (std::size_t i = 1; i < groups_.size(); ++i) add_joint(i, factors[i]);
        add_couplings();
        keep_apart(first_body);
        if (!root_moves()) keep_from_fixed(first_body);
        note_missing_shapes(first_body);
        for (const std::string& remark : remarks_)
            scene_.remarks.push_back(file_name_ + ": " + remark);
        return std::move(robot_);
    }

private:
    std::string full(const std::string& name) const { return robot_.name + "/" + name; }

    /// The root moves where it has a mass, unless it shall not.
    bool root_moves() const {
        const bool has_mass = mass_of(groups_[0]) > 0;
        if (options_.base == RobotBase::free && !has_mass)
            throw BadRobot(link_named(groups_[0].name()) +
                           ", the root, has no mass, so it cannot be free");
        return has_mass && options_.base != RobotBase::fixed;
    }

    void add_body(const LinkGroup& group, bool is_root) {
        const bool moves = !is_root || root_moves();
        BodySpec body;
        body.name = full(group.name());
        body.motion = moves ? Motion::dynamic : Motion::fixed;
        body.material = options_.material;
        body.placement = group.world;
        check_place(group.world.position, group.name());
        set_shape(body, collision_parts(group, moves, collision_, remarks_), group.world);
        masses_.emplace_back();
        if (moves) set_mass(body, group);
        if (!moves && body.geometry == kNoIndex) {
            bodies_.push_back(kNoIndex);
            return;
        }
        bodies_.push_back(static_cast<std::uint32_t>(scene_.bodies.size()));
        for (const GroupedLink& part : group.links)
            robot_.links.emplace_back(full(part.link->name), bodies_.back());
        scene_.bodies.push_back(std::move(body));
    }

    /// Numbers that the reader of scenes would refuse are refused here too.
    static void check_place(const Eigen::Vector3d& position, const std::string& link) {
        if (!(position.cwiseAbs().maxCoeff() <= kCoordinate.high))
            throw BadRobot(link_named(link) + " is too far away");
    }

    /// One shape is the body's, and the body's frame is the shape's; several are a compound.
    void set_shape(BodySpec& body, std::vector<GeometryPart> parts, const Placement& world) {
        if (parts.empty()) return;
        for (const GeometryPart& part : parts)
            check_place(part.local.position, body.name.substr(robot_.name.size() + 1));
        Geometry geometry;
        if (parts.size() == 1) {
            geometry = std::move(parts[0].geometry);
            body.placement = world * parts[0].local;
        } else {
            geometry.kind = ShapeKind::compound;
            geometry.parts = std::move(parts);
        }
        geometry.name = body.name;
        body.geometry = static_cast<std::uint32_t>(scene_.geometries.size());
        scene_.geometries.push_back(std::move(geometry));
    }

    void set_mass(BodySpec& body, const LinkGroup& group) {
        const MovingMass mass = moving_mass_of(group);
        masses_.back() = mass;
        body.mass = mass.mass, body.inertia = mass.moments;
        body.mass_frame = inverse(body.placement) * group.world * mass.frame;
    }

    void add_joint(std::size_t i, double frequency_factor) {
        const LinkGroup& group = groups_[i];
        note_left_out(*group.joint);
        if (group.joint->kind == RobotJointKind::floating) return;
        const auto start = starts_.find(group.joint->name);
        JointSpec joint =
            joint_of(group, start == starts_.end() ? 0 : start->second, options_, remarks_);
        for (JointAxisSpec& axis : joint.axes) axis.motor.frequency *= frequency_factor;
        joint.name = full(group.joint->name);
        joint.body_a = bodies_[i], joint.body_b = bodies_[group.parent];
        joints_[group.joint->name] = static_cast<std::uint32_t>(scene_.joints.size());
        robot_.joints.emplace_back(joint.name, joints_[group.joint->name]);
        scene_.joints.push_back(std::move(joint));
    }

    /// A joint without one coordinate has nothing that these could act on.
    void note_left_out(const RobotJoint& joint) {
        if (joint.has_coordinate()) return;
        if (joint.limits || joint.greatest_effort || joint.greatest_speed || joint.mimic ||
            joint.damping != 0 || joint.friction != 0)
            remarks_.push_back(joint_named(joint.name) + " is " +
                               (joint.kind == RobotJointKind::planar ? "planar" : "floating") +
                               ": its limits, damping and friction are left out");
    }

    void add_couplings() {
        for (const RobotJoint& joint : description_.joints) {
            if (!joint.mimic || !joint.has_coordinate()) continue;
            const RobotJoint& other = *description_.find_joint(joint.mimic->joint);
            CouplingSpec coupling = coupling_of(joint, other, starts_);
            coupling.name = full(joint.name);
            coupling.joint_a = joints_.at(other.name), coupling.joint_b = joints_.at(joint.name);
            scene_.couplings.push_back(std::move(coupling));
        }
    }

    /// Links that overlap where they start are not meant to collide, nor is any where the options
    /// say so.
    void keep_apart(std::uint32_t first) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> joined;
        for (const auto& entry : joints_) {
            const JointSpec& joint = scene_.joints[entry.second];
            joined.insert(std::minmax(joint.body_a, joint.body_b));
        }
        const auto end = static_cast<std::uint32_t>(scene_.bodies.size());
        std::string overlapping;
        for (std::uint32_t a = first; a < end; ++a) {
            for (std::uint32_t b = a + 1; b < end; ++b) {
                if (joined.contains({a, b})) continue;
                const BodySpec &x = scene_.bodies[a], &y = scene_.bodies[b];
                if (options_.self_collision) {
                    if (!are_overlapping(x, y)) continue;
                    overlapping += (overlapping.empty() ? "" : "; ") + x.name + " and " + y.name;
                }
                scene_.apart.push_back({a, b});
            }
        }
        if (!overlapping.empty())
            remarks_.push_back("links that overlap at the start do not collide: " + overlapping);
    }

    /// What is held in the world and begins inside something fixed cannot be pushed out of it.
    void keep_from_fixed(std::uint32_t first) {
        std::string sunk;
        const auto end = static_cast<std::uint32_t>(scene_.bodies.size());
        for (std::uint32_t a = 0; a < first; ++a) {
            for (std::uint32_t b = first; b < end; ++b) {
                const BodySpec &x = scene_.bodies[a], &y = scene_.bodies[b];
                if (x.motion != Motion::fixed || y.motion == Motion::fixed || !begins_in(y, x))
                    continue;
                sunk += (sunk.empty() ? "" : "; ") + y.name + " and " + x.name;
                scene_.apart.push_back({a, b});
            }
        }
        if (!sunk.empty())
            remarks_.push_back("links that begin in a fixed body do not collide with it: " + sunk);
    }

    /// Whether a link begins in a fixed body that is a plane or convex.
    bool begins_in(const BodySpec& link, const BodySpec& fixed) const {
        if (link.geometry == kNoIndex || fixed.geometry == kNoIndex) return false;
        const Geometry& other = scene_.geometries[fixed.geometry];
        if (other.kind == ShapeKind::plane)
            return lowest_point(scene_.geometries[link.geometry],
                                inverse(fixed.placement) * link.placement) < -kTouching;
        return other.kind != ShapeKind::mesh && are_overlapping(link, fixed);
    }

    void note_missing_shapes(std::uint32_t first) {
        for (std::size_t i = first; i < scene_.bodies.size(); ++i)
            if (scene_.bodies[i].geometry != kNoIndex) return;
        remarks_.emplace_back(
            "none of its links has a shape that collides, so it collides with nothing");
    }

    bool are_overlapping(const BodySpec& a, const BodySpec& b) const {
        if (a.geometry == kNoIndex || b.geometry == kNoIndex) return false;
        return overlap(scene_.geometries[a.geometry], a.placement, scene_.geometries[b.geometry],
                       b.placement);
    }

    Scene& scene_;
    const RobotOptions& options_;
    std::string file_name_;
    RobotDescription description_;
    std::vector<LinkGroup> groups_;
    CollisionOptions collision_;
    std::vector<std::string> remarks_;
    std::map<std::string, double> starts_;  // coordinates at the start, by joint [rad], [m]
    std::vector<std::optional<MovingMass>> masses_;  // [group], none where it is fixed
    std::vector<std::uint32_t> bodies_;              // [group], kNoIndex: the world
    std::map<std::string, std::uint32_t> joints_;    // indices by the names of the file
    Robot robot_;
};

/// Lifts or lowers a scene's bodies and joints by `y` [m].
void lift(Scene& scene, double y) {
    for (BodySpec& body : scene.bodies) body.placement.position.y() += y;
    for (JointSpec& joint : scene.joints) joint.anchor.y() += y;
}

double lowest_of_all(const Scene& scene) {
    double y = std::numeric_limits<double>::infinity();
    for (const BodySpec& body : scene.bodies) {
        if (body.geometry != kNoIndex)
            y = std::min(y, lowest_point(scene.geometries[body.geometry], body.placement));
    }
    return y;
}

}  // namespace
}  // namespace reader

Robot add_robot(Scene& scene, RobotDescription description, const std::filesystem::path& file,
                const RobotOptions& options) {
    try {
        return reader::RobotBuilder(scene, std::move(description), file, options).build();
    } catch (const reader::BadRobot& error) {
        throw SceneError(file.string(), "", error.what());
    }
}

Robot add_robot(Scene& scene, const std::filesystem::path& file, const RobotOptions& options) {
    return add_robot(scene, reader::load_robot(file), file, options);
}

Scene read_robot(const std::filesystem::path& file, const RobotOptions& options) {
    Scene scene;
    scene.name = add_robot(scene, file, options).name;
    const double lowest = reader::lowest_of_all(scene);
    if (std::isfinite(lowest)) reader::lift(scene, options.placement.position.y() - lowest);
    BodySpec& ground = add_ground(scene);
    ground.name = scene.geometries.back().name = "ground";
    scene.settings.dt = 0.005, scene.settings.leapfrog_start = true;
    return scene;
}

}  // namespace plumb
