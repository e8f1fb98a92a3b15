// SPDX-License-Identifier: MIT
/// What a user may read of the contacts of the last step.
#include "host/simulation_parts.h"

#include <stdexcept>

namespace plumb {
namespace {

const ContactRecord& kept(const std::optional<ContactRecord>& record) {
    if (!record)
        throw std::logic_error("contacts are not kept: call watch_contacts() before the step");
    return *record;
}

}  // namespace

void Simulation::watch_contacts(const ContactWatch& watch) {
    if (parts_->record) return parts_->record->watch(watch);
    parts_->record.emplace(watch);
    parts_->stepper.sums.emplace();
}

void Simulation::stop_watching_contacts() {
    parts_->record.reset();
    parts_->stepper.sums.reset();
}

const std::vector<BodyContact>& Simulation::contacts() const {
    return kept(parts_->record).contacts();
}
const std::vector<ParticleContact>& Simulation::particle_contacts() const {
    return kept(parts_->record).particle_contacts();
}
const std::vector<ContactEvent>& Simulation::contact_events() const {
    return kept(parts_->record).events();
}

}  // namespace plumb
