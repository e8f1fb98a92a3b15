// SPDX-License-Identifier: MIT
/// What contacts bear in a whole step: the sum over its substeps of what impacts, both passes,
/// exact islands and shock propagation push. Kept only for those who ask; nothing in a step depends
/// on it.
#pragma once

#include "contacts/contact_measures.h"

#include <algorithm>
#include <vector>

namespace plumb {

struct ContactSum {
    double normal = 0;                     ///< [N s]
    Vector3d friction = Vector3d::Zero();  ///< on a, world frame [N s]
    double approach = 0;  ///< of the substeps in which it bore something, the greatest speed at
                          ///< which the surfaces approached at the start [m/s]
};

class ContactSums {
public:
    /// Once a step, when its contacts are known.
    void begin_step(const World& world) {
        bodies_.assign(world.contacts.found.size(), {});
        particles_.assign(world.particle_contacts.found.size(), {});
    }

    /// Once a substep, before its impacts.
    void begin_substep(const World& world) {
        const ContactTable& c = world.contacts;
        approach_.resize(c.found.size());
        for (std::size_t i = 0; i < c.found.size(); ++i)
            approach_[i] = -separating_velocity(world.bodies, c.found[i], c.point[i]);
    }

    void add(std::size_t contact, double normal, const Vector3d& friction) {
        ContactSum& sum = bodies_[contact];
        sum.normal += normal, sum.friction += friction;
        if (normal > 0) sum.approach = std::max(sum.approach, approach_[contact]);
    }
    void add_of_particle(std::size_t contact, double normal, const Vector3d& friction) {
        particles_[contact].normal += normal, particles_[contact].friction += friction;
    }

    /// In the order of the tables' contacts.
    const std::vector<ContactSum>& bodies() const { return bodies_; }
    const std::vector<ContactSum>& particles() const { return particles_; }

private:
    std::vector<ContactSum> bodies_, particles_;
    std::vector<double> approach_;  // at the start of the substep, without its forces [m/s]
};

}  // namespace plumb
