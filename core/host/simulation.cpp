// SPDX-License-Identifier: MIT
#include "host/simulation.h"

#include "host/add_bodies.h"
#include "measure/measure.h"
#include "scene/error.h"
#include "step/step.h"

#include <stdexcept>

namespace plumb {

struct Simulation::Parts {
    World world;
    Stepper stepper;
    ProximityPtr owned;
    Proximity& proximity;
    std::string collider_name, collider_version;

    Parts(const Scene& scene, ProximityPtr plugin, Proximity& p, std::string name,
          std::string version)
        : world(build_world(scene)),
          stepper(world),
          owned(std::move(plugin)),
          proximity(p),
          collider_name(std::move(name)),
          collider_version(std::move(version)) {
        if (!stepper.plan.runs(Effect::contacts)) return;
        add_bodies(proximity, world, scene, collider_name);
    }

    std::size_t checked(std::uint32_t body) const {
        if (body >= world.bodies.size())
            throw std::out_of_range("there is no body " + std::to_string(body));
        return body;
    }
};

namespace {

const ColliderInfo& chosen(const Scene& scene, const ColliderLibrary& colliders,
                           const std::string& name) {
    const ColliderInfo& info = name == "auto" ? colliders.choose(scene) : colliders.find(name);
    colliders.check_abilities(info, scene);
    return info;
}

}  // namespace

Simulation::Simulation(const Scene& scene, Proximity& proximity, std::string collider_name)
    : parts_(std::make_unique<Parts>(scene, ProximityPtr(), proximity, std::move(collider_name),
                                     "")) {}

Simulation::Simulation(const Scene& scene, const ColliderLibrary& colliders,
                       const std::string& collider) {
    const ColliderInfo& info = chosen(scene, colliders, collider);
    ProximityPtr plugin = colliders.create(info, scene.settings.threads);
    Proximity& proximity = *plugin;
    const char* version = info.table->backend_version;
    parts_ = std::make_unique<Parts>(scene, std::move(plugin), proximity, info.name,
                                     version ? version : "");
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
void Simulation::capture(Frame& frame) const { plumb::capture(parts_->world, frame); }

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

}  // namespace plumb
