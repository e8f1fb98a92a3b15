// SPDX-License-Identifier: MIT
/// A shape that the collider has for as long as a question lasts. Private to Simulation.
#pragma once

#include "contacts/contact_room.h"
#include "host/simulation_parts.h"

#include <vector>

namespace plumb {

std::vector<Pose> poses_of(const Bodies& bodies);

/// Tells the collider where bodies are, and asks for the contacts, up to a gap [m], of the pairs
/// that are let through.
Status place_all(Proximity& proximity, const std::vector<Pose>& poses, const PairFilter& filter,
                 double margin, ContactRoom& room);

/// It stands behind the last body, and meets the bodies with (group & mask) != 0.
class Simulation::Parts::Guest {
public:
    /// Throws std::out_of_range where there is no such geometry, and ColliderError where the
    /// collider refuses it.
    Guest(Parts& parts, std::uint32_t geometry, std::uint32_t mask);
    /// After an exception: the collider is asked to forget it, and not whether it did.
    ~Guest();
    Guest(const Guest&) = delete;
    Guest& operator=(const Guest&) = delete;

    /// Its contacts with bodies up to a gap [m], if it stood there; it is b of each. They stay
    /// until the next call.
    const std::vector<Contact>& contacts_at(const Placement& placement, double margin);

    /// Once there are no more questions. Throws ColliderError where the collider keeps it.
    void leave();

    /// About the origin of its placement [m].
    double bounding_radius() const;

private:
    Parts& parts_;
    std::uint32_t geometry_, slot_;
    bool is_here_ = true;
    std::vector<Pose> poses_;
    std::vector<Contact> contacts_;
    ContactRoom room_;
};

}  // namespace plumb
