// SPDX-License-Identifier: MIT
/// Bodies, joints and couplings of a running simulation come and go.
#include "host/simulation_parts.h"
#include "scene/error.h"
#include "world/derived.h"
#include "world/edit_world.h"
#include "world/sleep.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace plumb {
namespace {

/// Whether two bodies of the table meet others of the same shapes by the same rules as the new one.
bool is_well_known(const Bodies& b, const BodyRow& row) {
    int alike = 0;
    for (std::size_t i = 0; i < b.size() && alike < 2; ++i)
        alike += b.geometry[i] == row.geometry && awake(b.motion[i]) == row.motion &&
                 b.group[i] == row.group && b.mask[i] == row.mask;
    return alike == 2;
}

void check_material(const Material& m) {
    const double parts[] = {m.density, m.friction, m.restitution, m.rolling_friction,
                            m.spinning_friction};
    for (const double x : parts)
        if (!std::isfinite(x) || x < 0)
            throw std::invalid_argument("a material's numbers must be finite and 0 or above");
    if (m.restitution > 1) throw std::invalid_argument("restitution must be 1 or below");
}

}  // namespace

void Simulation::Parts::check_pairs(const BodyRow& row, const std::string& name) {
    const Bodies& b = world.bodies;
    if (!library || row.geometry == kNoIndex || is_well_known(b, row)) return;
    Scene pairs;
    const auto put = [&](const std::string& called, const BodyRow& r) {
        BodySpec& spec = pairs.bodies.emplace_back();
        spec.name = called, spec.motion = r.motion, spec.geometry = r.geometry;
        spec.group = r.group, spec.mask = r.mask;
    };
    for (std::uint32_t i = 0; i < b.size(); ++i)
        if (b.geometry[i] != kNoIndex) put(std::to_string(b.id[i]), shape_row(b, i));
    put(name.empty() ? std::to_string(world.slots.next().id) : name, row);
    pairs.geometries.swap(assets.geometries);
    try {
        library->check_abilities(library->find(collider_name), pairs);
    } catch (...) {
        pairs.geometries.swap(assets.geometries);
        throw;
    }
    pairs.geometries.swap(assets.geometries);
}

void Simulation::Parts::hand_over(std::uint32_t slot, const BodyRow& row) {
    if (filled) return plumb::add_body(proximity, world, slot, row, collider_name);
    outdated = true;
    renew();
    if (!stepper.plan.runs(Effect::contacts)) return;
    add_bodies(proximity, world, collider_name);
    filled = true;
}

std::uint32_t Simulation::add_geometry(const Geometry& geometry) {
    parts_->world.shapes.add(geometry);
    parts_->assets.geometries.push_back(geometry);
    return static_cast<std::uint32_t>(parts_->assets.geometries.size()) - 1;
}

std::uint32_t Simulation::add_material(const Material& material) {
    check_material(material);
    parts_->assets.materials.push_back(material);
    combine_surfaces(parts_->world, parts_->assets);
    parts_->outdated = true;
    return static_cast<std::uint32_t>(parts_->assets.materials.size()) - 1;
}

std::uint32_t Simulation::add_body(const BodySpec& body) {
    World& world = parts_->world;
    const auto [id, slot] = world.slots.next();
    BodyRow row = make_body(parts_->assets, body, "/bodies/" + std::to_string(id));
    row.id = id;
    parts_->check_pairs(row, body.name);
    insert_body(world, row);
    try {
        parts_->hand_over(slot, row);
    } catch (...) {
        erase_body(world, slot);
        world.slots.forget_last();
        parts_->outdated = true;
        throw;
    }
    parts_->outdated = true;
    parts_->placed = false;
    parts_->wake_near(slot);
    if (!body.name.empty()) parts_->body_names.emplace(body.name, id);
    return id;
}

void Simulation::remove_body(std::uint32_t body) {
    World& world = parts_->world;
    const std::uint32_t slot = parts_->slot(body);
    if (parts_->filled) plumb::remove_body(parts_->proximity, world, slot, parts_->collider_name);
    parts_->wake_near(slot);
    const std::vector<Joint>& joints = world.joints.joints;
    for (auto i = static_cast<std::uint32_t>(joints.size()); i-- > 0;)
        if (joints[i].a == slot || joints[i].b == slot) erase_joint(world, i);
    erase_body(world, slot);
    parts_->outdated = true;
    parts_->placed = false;
}

std::uint32_t Simulation::add_joint(const JointSpec& joint) {
    World& world = parts_->world;
    JointSpec placed = joint;
    placed.body_a = parts_->slot(joint.body_a);
    if (joint.body_b != kNoIndex) placed.body_b = parts_->slot(joint.body_b);
    JointDraft draft = make_joint(world, placed, "/joints/" + std::to_string(world.joints.next_id));
    if (parts_->filled && draft.joint.keeps_apart)
        exclude_pair(parts_->proximity, world, kept_apart(draft.joint), true,
                     parts_->collider_name);
    parts_->outdated = true;
    const std::uint32_t id = insert_joint(world, std::move(draft));
    parts_->wake_joined_by(parts_->joint_index(id));
    if (!joint.name.empty()) parts_->joint_names.emplace(joint.name, id);
    return id;
}

void Simulation::remove_joint(std::uint32_t joint) {
    World& world = parts_->world;
    const std::uint32_t index = parts_->joint_index(joint);
    const Joint& old = world.joints.joints[index];
    const std::uint64_t pair = old.keeps_apart ? kept_apart(old) : 0;
    const auto reasons = std::count(world.excluded.begin(), world.excluded.end(), pair);
    if (parts_->filled && old.keeps_apart && reasons == 1)
        exclude_pair(parts_->proximity, world, pair, false, parts_->collider_name);
    parts_->wake_joined_by(index);
    erase_joint(world, index);
    parts_->outdated = true;
}

namespace {

/// A joint's coordinate now; what is only rounding beside where it was made counts as that.
double coordinate_now(const World& world, std::uint32_t joint, std::uint32_t axis) {
    const double start = start_coordinate(world, joint);
    const double now = joint_coordinate(world, joint, axis).value;
    return std::abs(now - start) < 1e-12 ? start : now;
}

}  // namespace

std::uint32_t Simulation::add_coupling(const CouplingSpec& coupling) {
    World& world = parts_->world;
    CouplingSpec placed = coupling;
    placed.joint_a = parts_->joint_index(coupling.joint_a);
    placed.joint_b = parts_->joint_index(coupling.joint_b);
    JointCoupling made =
        make_coupling(world, placed, "/couplings/" + std::to_string(world.joints.next_coupling_id));
    if (!coupling.offset)
        made.offset = coordinate_now(world, made.joint_b, made.axis_b) -
                      made.ratio * coordinate_now(world, made.joint_a, made.axis_a);
    append_coupling(world, made);
    parts_->wake_joined_by(made.joint_a), parts_->wake_joined_by(made.joint_b);
    parts_->outdated = true;
    return world.joints.couplings.back().id;
}

void Simulation::remove_coupling(std::uint32_t coupling) {
    const std::uint32_t index = parts_->coupling_index(coupling);
    parts_->wake_joined_by(parts_->world.joints.couplings[index].joint_a);
    erase_coupling(parts_->world, index);
    parts_->outdated = true;
}

}  // namespace plumb
