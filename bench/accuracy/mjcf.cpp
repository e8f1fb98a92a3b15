// SPDX-License-Identifier: MIT
#include "accuracy/mjcf.h"

#include "accuracy/peer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace plumb::bench {
namespace {

constexpr const char* kHardest = "0.9999 0.9999 0.001";  // greatest impedance that there is
// A bounce takes this times the root of a step, and so long is a contact's time constant [√s]:
// were they shares of a step, neither restitution nor the hops of what slides would converge.
constexpr double kBounceRoot = 0.5, kContactRoot = 0.15;

/// Damping ratio of a spring and damper that only push, for a restitution e:
/// e = exp(−2 ζ/√(1−ζ²) atan(√(1−ζ²)/ζ)); by bisection.
double damping_ratio(double restitution) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double z = 0.5 * (low + high), s = std::sqrt(1 - z * z);
        (std::exp(-2 * z / s * std::atan2(s, z)) > restitution ? low : high) = z;
    }
    return low;
}

class Writer {
public:
    Writer(const Scene& scene, const World& world, double dt)
        : scene_(scene), world_(world), dt_(dt), hangs_(scene.bodies.size()) {
        text_.precision(17);
    }

    std::string all(const MujocoMethod& method) {
        hang_all();
        text_ << "<mujoco><compiler inertiafromgeom='false' angle='radian'/><option timestep='"
              << dt_ << "' gravity='" << scene_.settings.gravity.transpose() << "' integrator='"
              << method.integrator << "' cone='" << method.cone
              << "' solver='Newton' impratio='100' tolerance='1e-12'/>";
        text_ << "<size njmax='" << 100 * scene_.bodies.size() << "' nconmax='"
              << 25 * scene_.bodies.size() << "'/><default>";
        write_contact_default();
        text_ << "</default><worldbody>";
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            if (!is_dynamic(world_, i))
                write_geom(i, geometry_placement(world_.bodies, i));
            else if (hangs_[i].from == kNoIndex)
                write_body(i, {});
        }
        text_ << "</worldbody><equality>";
        for (const JointSpec& joint : scene_.joints)
            if (!is_used(joint)) write_loop(joint);
        for (const CouplingSpec& coupling : scene_.couplings)
            text_ << "<joint joint1='j" << coupling.joint_b << "' joint2='j" << coupling.joint_a
                  << "' polycoef='0 " << coupling.ratio << " 0 0 0' solref='" << 2 * dt_
                  << " 1' solimp='" << kHardest << "'/>";
        text_ << "</equality></mujoco>";
        return text_.str();
    }

private:
    /// Trees that grow from the world level by level, so that a chain with two ends is cut halfway.
    void hang_all() {
        std::vector<std::uint32_t> level{kNoIndex};
        while (!level.empty()) {
            std::vector<std::uint32_t> next;
            for (const std::uint32_t from : level)
                for (const JointSpec& joint : scene_.joints) {
                    if (joint.body_a != from && joint.body_b != from) continue;
                    const std::uint32_t body = joint.body_b == from ? joint.body_a : joint.body_b;
                    if (body == kNoIndex || hangs_[body].by) continue;
                    hangs_[body] = {&joint, from};
                    next.push_back(body);
                }
            level = std::move(next);
        }
    }
    bool is_used(const JointSpec& joint) const {
        return std::any_of(hangs_.begin(), hangs_.end(),
                           [&](const Hanging& h) { return h.by == &joint; });
    }

    Placement placement(std::size_t i) const {
        return {world_.bodies.position[i], world_.bodies.orientation[i]};
    }

    void write_contact_default() {
        const SurfacePair& surface = world_.surface_pairs[0];
        const bool meets = collides(scene_);
        text_ << "<geom contype='" << meets << "' conaffinity='" << meets << "' condim='"
              << (surface.friction > 0 ? 3 : 1) << "' friction='" << surface.friction
              << " 0 0' solimp='" << kHardest << "' solref='";
        if (surface.restitution > 0) {
            const double rate = std::numbers::pi / (kBounceRoot * std::sqrt(dt_));
            text_ << -rate * rate << " " << -2 * damping_ratio(surface.restitution) * rate;
        } else {
            text_ << std::max(2 * dt_, kContactRoot * std::sqrt(dt_)) << " 1";
        }
        text_ << "'/>";
    }

    void write_placement(const Placement& p) {
        const Quaterniond& q = p.rotation;
        text_ << " pos='" << p.position.transpose() << "' quat='" << q.w() << " " << q.x() << " "
              << q.y() << " " << q.z() << "'";
    }

    void write_geom(std::size_t i, Placement at) {
        if (scene_.bodies[i].geometry == kNoIndex) return;
        const Geometry& g = scene_.geometries[scene_.bodies[i].geometry];
        text_ << "<geom type='";
        if (g.kind == ShapeKind::plane || g.kind == ShapeKind::cylinder)  // along z
            at = at * Placement{Vector3d::Zero(), z_to_y()};
        if (g.kind == ShapeKind::plane) {
            text_ << "plane' size='0 0 1'";
        } else if (g.kind == ShapeKind::cylinder) {
            text_ << "cylinder' size='" << g.radius << " " << g.half_height << "'";
        } else if (g.kind == ShapeKind::box) {
            text_ << "box' size='" << g.half_extents.transpose() << "'";
        } else {
            text_ << "sphere' size='" << g.radius << "'";
        }
        write_placement(at);
        text_ << "/>";
    }

    /// A body in its parent's frame, and those that hang from it.
    void write_body(std::size_t i, const Placement& parent) {
        text_ << "<body name='" << body_name(i) << "'";
        write_placement(inverse(parent) * placement(i));
        text_ << "><inertial pos='0 0 0' mass='" << world_.bodies.mass[i] << "' diaginertia='"
              << world_.bodies.inertia[i].transpose() << "'/>";
        if (hangs_[i].by)
            write_joint(*hangs_[i].by, static_cast<std::uint32_t>(i));
        else
            text_ << "<freejoint/>";
        write_geom(i, world_.bodies.geometry_in_body[i]);
        for (std::size_t k = 0; k < scene_.bodies.size(); ++k)
            if (hangs_[k].from == i) write_body(k, placement(i));
        text_ << "</body>";
    }

    /// A rod is rigid with its body a: a chain that hangs straight is the same.
    void write_joint(const JointSpec& joint, std::uint32_t body) {
        const Bodies& b = world_.bodies;
        const Vector3d at = in_body(b, body, joint.anchor_b.value_or(joint.anchor));
        const Vector3d axis = b.orientation[body].conjugate() * joint.frame * Vector3d::UnitX();
        const auto number = &joint - scene_.joints.data();
        if (joint.compliance > 0)
            for (int k = 0; k < 3; ++k)
                text_ << "<joint type='slide' axis='" << Vector3d::Unit(k).transpose()
                      << "' stiffness='" << 1 / joint.compliance << "'/>";
        text_ << "<joint name='j" << number << "' pos='" << at.transpose() << "' type='"
              << (joint.kind == JointKind::hinge ? "hinge" : "ball") << "' axis='"
              << axis.transpose() << "'/>";
    }

    void write_loop(const JointSpec& joint) {
        text_ << "<connect body1='" << body_name(joint.body_a) << "' anchor='"
              << in_body(world_.bodies, joint.body_a, joint.anchor).transpose() << "' solref='"
              << 2 * dt_ << " 1' solimp='" << kHardest << "'";
        if (joint.body_b != kNoIndex) text_ << " body2='" << body_name(joint.body_b) << "'";
        text_ << "/>";
    }

    const Scene& scene_;
    const World& world_;
    double dt_;
    struct Hanging {
        const JointSpec* by = nullptr;
        std::uint32_t from = kNoIndex;  ///< body; kNoIndex: the world
    };
    std::vector<Hanging> hangs_;  ///< [body]
    std::ostringstream text_;
};

}  // namespace

std::string body_name(std::size_t body) { return std::string(1, 'b').append(std::to_string(body)); }

std::string mjcf(const Scene& scene, const World& world, double dt, const MujocoMethod& method) {
    return Writer(scene, world, dt).all(method);
}

}  // namespace plumb::bench
