// SPDX-License-Identifier: MIT
/// The contacts and events of a step, from the world's tables to what programs read.
#pragma once

#include "host/body_contact.h"
#include "step/step.h"

#include <utility>
#include <vector>

namespace plumb {

class ContactRecord {
public:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;  ///< identifiers, the lower one first

    explicit ContactRecord(const ContactWatch& watch) : watch_(watch) {}

    /// After a step that summed impulses.
    void take(const World& world, const Stepper& stepper);

    /// What a hit is from now on.
    void watch(const ContactWatch& watch) { watch_ = watch; }

    const std::vector<BodyContact>& contacts() const { return contacts_; }
    const std::vector<ParticleContact>& particle_contacts() const { return particle_contacts_; }
    const std::vector<ContactEvent>& events() const { return events_; }

    /// The pairs that touch, sorted: all that a step leaves for the events of the next.
    const std::vector<Pair>& touching() const { return touching_; }

    /// As after a step that left these pairs touching.
    void start_from(std::vector<Pair> touching);

private:
    void take_contacts(const World& world, const Stepper& stepper);
    /// The contact of a table in which it is the i-th.
    void add_contact(const World& world, const RememberedContacts& table, std::size_t i,
                     const ContactSum& sum);
    void take_particles(const World& world, const Stepper& stepper);
    void reserve_events();
    void take_events();
    void tell_end(const Pair& pair);

    ContactWatch watch_;
    std::vector<BodyContact> contacts_;
    std::vector<ParticleContact> particle_contacts_;
    std::vector<ContactEvent> events_;
    std::vector<Pair> touching_, touched_before_;
};

}  // namespace plumb
