// SPDX-License-Identifier: MIT
#include "host/simulation.h"

#include "host/add_bodies.h"
#include "measure/measure.h"
#include "scene/error.h"
#include "step/step.h"

#include <cmath>
#include <stdexcept>

namespace plumb {

struct Simulation::Parts {
    World world;
    Stepper stepper;
    ProximityPtr owned;
    Proximity& proximity;
    std::string collider_name, collider_version, collider_reason;

    Parts(const Scene& scene, ProximityPtr plugin, Proximity& p, std::string name,
          std::string version)
        : world(build_world(scene)),
          stepper(world),
          owned(std::move(plugin)),
          proximity(p),
          collider_name(std::move(name)),
          collider_version(std::move(version)) {
        auto& warnings = stepper.plan.warnings;
        warnings.insert(warnings.begin(), scene.remarks.begin(), scene.remarks.end());
        if (!stepper.plan.runs(Effect::contacts)) return;
        add_bodies(proximity, world, scene, collider_name);
    }

    std::size_t checked(std::uint32_t body) const {
        if (body >= world.bodies.size())
            throw std::out_of_range("there is no body " + std::to_string(body));
        return body;
    }

    /// The collider, for questions at the poses of its last detection.
    Proximity& placed() const {
        if (!stepper.plan.runs(Effect::contacts))
            throw std::logic_error("the scene has no contacts, so the collider has no bodies");
        if (world.steps == 0)
            throw std::logic_error("the collider has no poses before the first step");
        return proximity;
    }

    /// Throws unless the collider answered a question.
    void expect_answer(const Status& status, const std::string& question) const {
        if (status.code == Status::ok) return;
        const std::string sentence = "collider \"" + collider_name + "\" gave no " + question +
                                     ": " + (status.message ? status.message : "it gave no reason");
        if (status.code == Status::bad_argument) throw std::invalid_argument(sentence);
        throw ColliderError(sentence);
    }
};

namespace {

ColliderChoice chosen(const Scene& scene, const ColliderLibrary& colliders,
                      const std::string& name) {
    if (name == "auto") return colliders.choose(scene);
    const ColliderInfo& info = colliders.find(name);
    colliders.check_abilities(info, scene);
    return {&info, ""};
}

}  // namespace

Simulation::Simulation(const Scene& scene, Proximity& proximity, std::string collider_name)
    : parts_(std::make_unique<Parts>(scene, ProximityPtr(), proximity, std::move(collider_name),
                                     "")) {}

Simulation::Simulation(const Scene& scene, const ColliderLibrary& colliders,
                       const std::string& collider) {
    const ColliderChoice choice = chosen(scene, colliders, collider);
    const ColliderInfo& info = *choice.collider;
    ProximityPtr plugin = colliders.create(info, scene.settings.threads);
    Proximity& proximity = *plugin;
    const char* version = info.table->backend_version;
    parts_ = std::make_unique<Parts>(scene, std::move(plugin), proximity, info.name,
                                     version ? version : "");
    parts_->collider_reason = choice.reason;
}

Simulation::~Simulation() = default;

StepReport Simulation::step() {
    return plumb::step(parts_->world, parts_->stepper, parts_->proximity);
}
double Simulation::time() const { return parts_->world.time; }
std::uint64_t Simulation::steps() const { return parts_->world.steps; }
const World& Simulation::world() const { return parts_->world; }
const Plan& Simulation::plan() const { return parts_->stepper.plan; }
const Ledger& Simulation::ledger() const { return parts_->stepper.ledger; }
DetectStats Simulation::detect_stats() const { return parts_->proximity.stats(); }
const std::string& Simulation::collider_name() const { return parts_->collider_name; }
const std::string& Simulation::collider_version() const { return parts_->collider_version; }
const std::string& Simulation::collider_reason() const { return parts_->collider_reason; }
void Simulation::capture(Frame& frame) const { plumb::capture(parts_->world, frame); }

std::optional<RayHit> Simulation::cast_ray(const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction, double length,
                                           std::uint32_t mask) {
    const RayRequest ray{to_plain(origin), to_plain(direction), length, mask, 0};
    RayHit hit{kNoBody, 0, 0, {0, 0, 0}};
    parts_->expect_answer(parts_->placed().cast_rays(&ray, &hit, 1), "hit of a ray");
    if (hit.body == kNoBody) return std::nullopt;
    return hit;
}

Contact Simulation::closest(std::uint32_t body_a, std::uint32_t body_b) {
    parts_->checked(body_a), parts_->checked(body_b);
    Contact contact{};
    parts_->expect_answer(parts_->placed().closest(body_a, body_b, &contact), "closest points");
    return contact;
}

void Simulation::set_velocity(std::uint32_t body, const Eigen::Vector3d& v,
                              const Eigen::Vector3d& w) {
    Bodies& b = parts_->world.bodies;
    const std::size_t i = parts_->checked(body);
    if (b.motion[i] == Motion::fixed) throw std::invalid_argument("a fixed body has no velocity");
    b.velocity[i] = v, b.angular_velocity[i] = w;
}

void Simulation::set_force(std::uint32_t body, const Eigen::Vector3d& force,
                           const Eigen::Vector3d& torque) {
    const std::size_t i = parts_->checked(body);
    parts_->world.bodies.force[i] = force, parts_->world.bodies.torque[i] = torque;
}

namespace {

const Joint& checked_joint(const World& world, std::uint32_t joint) {
    if (joint >= world.joints.size())
        throw std::out_of_range("there is no joint " + std::to_string(joint));
    return world.joints.joints[joint];
}

}  // namespace

Simulation::JointMotion Simulation::joint_motion(std::uint32_t joint, std::uint32_t axis) const {
    const World& world = parts_->world;
    const Joint& j = checked_joint(world, joint);
    if (axis >= kJointAxes || j.locked[axis])
        throw std::invalid_argument("the joint has no free axis " + std::to_string(axis));
    const JointCoordinate q = joint_coordinate(world, joint, axis);
    const auto part = [&](std::uint32_t body, const Vector3d& turn) {
        if (body == kNoIndex) return 0.0;
        return q.along.dot(world.bodies.velocity[body]) +
               turn.dot(world.bodies.angular_velocity[body]);
    };
    return {q.value, part(j.a, q.turn_a) - part(j.b, q.turn_b)};
}

JointLoad Simulation::joint_load(std::uint32_t joint) const {
    checked_joint(parts_->world, joint);
    return plumb::joint_load(parts_->world, joint);
}

bool Simulation::is_broken(std::uint32_t joint) const {
    return checked_joint(parts_->world, joint).broken;
}

void Simulation::set_motor_target(std::uint32_t joint, std::uint32_t axis, double target) {
    checked_joint(parts_->world, joint);
    if (!std::isfinite(target)) throw std::invalid_argument("a motor's target must be finite");
    for (JointDrive& drive : parts_->world.joints.drives)
        if (drive.joint == joint && drive.axis == axis && drive.kind == DriveKind::motor) {
            drive.spec.motor.keys.clear();
            drive.spec.motor.target = target;
            return;
        }
    throw std::invalid_argument("the joint has no motor on axis " + std::to_string(axis));
}

}  // namespace plumb
