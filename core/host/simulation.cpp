// SPDX-License-Identifier: MIT
#include "host/simulation.h"

#include "host/log.h"
#include "host/simulation_parts.h"
#include "measure/measure.h"
#include "scene/error.h"
#include "world/derived.h"
#include "world/sleep.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace plumb {

namespace {

/// What edits need of a scene.
Scene assets_of(const Scene& scene) {
    Scene assets;
    assets.materials = scene.materials, assets.material_pairs = scene.material_pairs;
    assets.geometries = scene.geometries;
    assets.remarks = scene.remarks;
    return assets;
}

template <class Spec>
void add_names(Names& names, const std::vector<Spec>& specs) {
    for (std::size_t i = 0; i < specs.size(); ++i)
        if (!specs[i].name.empty()) names.emplace(specs[i].name, static_cast<std::uint32_t>(i));
}

/// The index of the entry of an identifier in a table that is sorted by them.
template <class Entry>
std::uint32_t index_of(const std::vector<Entry>& table, std::uint32_t id, std::uint32_t next_id,
                       const char* kind) {
    const auto at = std::lower_bound(table.begin(), table.end(), id,
                                     [](const Entry& e, std::uint32_t x) { return e.id < x; });
    if (at != table.end() && at->id == id) return static_cast<std::uint32_t>(at - table.begin());
    const std::string name = kind + (" " + std::to_string(id));
    throw std::out_of_range(id < next_id ? name + " was removed" : "there is no " + name);
}

}  // namespace

Simulation::Parts::Parts(const Scene& scene, ProximityPtr plugin, Proximity& p, std::string name,
                         std::string version)
    : assets(assets_of(scene)),
      world(build_world(scene)),
      stepper(world),
      owned(std::move(plugin)),
      proximity(p),
      collider_name(std::move(name)),
      collider_version(std::move(version)) {
    auto& warnings = stepper.plan.warnings;
    warnings.insert(warnings.begin(), assets.remarks.begin(), assets.remarks.end());
    note_broken_joints();
    add_names(body_names, scene.bodies), add_names(joint_names, scene.joints);
    filled = stepper.plan.runs(Effect::contacts);
    if (filled) add_bodies(proximity, world, collider_name);
    tell_warnings();
}

void Simulation::Parts::renew() {
    if (!outdated) return;
    assign_rows(world);
    stepper.renew(world);
    auto& warnings = stepper.plan.warnings;
    warnings.insert(warnings.begin(), assets.remarks.begin(), assets.remarks.end());
    tell_warnings();
    note_broken_joints();
    outdated = false;
}

void Simulation::Parts::wake_near(std::uint32_t slot) { outdated |= plumb::wake_near(world, slot); }

void Simulation::Parts::wake_joined_by(std::uint32_t joint) {
    wake_near(world.joints.joints[joint].a);  // the other body, too, if it sleeps
}

void Simulation::Parts::note_broken_joints() {
    broken.clear();
    for (const Joint& joint : world.joints.joints) broken.push_back(joint.broken);
}

std::uint32_t Simulation::Parts::slot(std::uint32_t body) const {
    if (const auto found = world.slots.find(body)) return *found;
    const std::string name = "body " + std::to_string(body);
    throw std::out_of_range(world.slots.knew(body) ? name + " was removed" : "there is no " + name);
}

std::uint32_t Simulation::Parts::joint_index(std::uint32_t joint) const {
    return index_of(world.joints.joints, joint, world.joints.next_id, "joint");
}

std::uint32_t Simulation::Parts::coupling_index(std::uint32_t coupling) const {
    return index_of(world.joints.couplings, coupling, world.joints.next_coupling_id, "coupling");
}

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
    parts_->library = colliders;
    if (!choice.reason.empty()) logger()->debug("collider {}: {}", info.name, choice.reason);
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

StepReport Simulation::step() {
    parts_->renew();
    StepReport report = plumb::step(parts_->world, parts_->stepper, parts_->proximity);
    parts_->placed = false;
    parts_->outdated = report.torn_elements > 0;
    parts_->stats = parts_->proximity.stats();
    parts_->residual = report.residual;
    parts_->tell_step(report);
    if (parts_->record) parts_->record->take(parts_->world, parts_->stepper);
    return report;
}
double Simulation::time() const { return parts_->world.time; }
std::uint64_t Simulation::steps() const { return parts_->world.steps; }
const World& Simulation::world() const { return parts_->world; }
const Plan& Simulation::plan() const {
    parts_->renew();
    return parts_->stepper.plan;
}
const Ledger& Simulation::ledger() const { return parts_->stepper.ledger; }
DetectStats Simulation::detect_stats() const { return parts_->stats; }
const std::vector<IslandResidual>& Simulation::island_residuals() const {
    return parts_->stepper.solver->island_residuals();
}
const std::string& Simulation::collider_name() const { return parts_->collider_name; }
const std::string& Simulation::collider_version() const { return parts_->collider_version; }
const std::string& Simulation::collider_reason() const { return parts_->collider_reason; }
void Simulation::capture(Frame& frame) const {
    plumb::capture(parts_->world, frame);
    frame.residual = parts_->residual;
}

Simulation::JointMotion Simulation::joint_motion(std::uint32_t joint, std::uint32_t axis) const {
    const World& world = parts_->world;
    const std::uint32_t index = parts_->joint_index(joint);
    const Joint& j = world.joints.joints[index];
    if (axis >= kJointAxes || j.locked[axis])
        throw std::invalid_argument("the joint has no free axis " + std::to_string(axis));
    const JointCoordinate q = joint_coordinate(world, index, axis);
    return {q.value, joint_rate(world.bodies, j, q)};
}

JointLoad Simulation::joint_load(std::uint32_t joint) const {
    return plumb::joint_load(parts_->world, parts_->joint_index(joint));
}

bool Simulation::is_broken(std::uint32_t joint) const { return parts_->joint(joint).broken; }

}  // namespace plumb
