// SPDX-License-Identifier: MIT
/// Contacts of this step and of the step before are both sorted, so one walk along both finds what stayed.
#include "step/stages.h"

namespace plumb {
namespace {

/// −1, 0, 1: order of the pairs of bodies.
int compare_pairs(const Contact& x, const Contact& y) {
    if (x.a != y.a) return x.a < y.a ? -1 : 1;
    if (x.b != y.b) return x.b < y.b ? -1 : 1;
    return 0;
}

/// End of the run of contacts that share the pair of contact `i`.
std::size_t end_of_pair(const std::vector<Contact>& contacts, std::size_t i) {
    std::size_t end = i + 1;
    while (end < contacts.size() && compare_pairs(contacts[i], contacts[end]) == 0) ++end;
    return end;
}

}  // namespace

void match_contacts(World& world, const Plan& plan) {
    ContactTable& c = world.contacts;
    c.memory.assign(c.found.size(), ContactMemory{});
    std::size_t old = 0;
    for (std::size_t i = 0; i < c.found.size();) {
        const std::size_t end = end_of_pair(c.found, i);
        while (old < c.found_before.size() && compare_pairs(c.found_before[old], c.found[i]) < 0) ++old;
        if (old < c.found_before.size() && compare_pairs(c.found_before[old], c.found[i]) == 0) {
            const std::size_t old_end = end_of_pair(c.found_before, old);
            for (std::size_t k = i; k < end; ++k)
                for (std::size_t j = old; j < old_end; ++j)
                    if (c.found[k].feature != 0 && c.found[k].feature == c.found_before[j].feature) {
                        c.memory[k] = c.memory_before[j];
                        c.memory[k].matched = true;
                        break;
                    }
            old = old_end;
        }
        i = end;
    }

    if (!plan.runs(Effect::sticking_anchors)) return;
    const Bodies& b = world.bodies;
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        ContactMemory& m = c.memory[i];
        const Contact& contact = c.found[i];
        if (m.sticks || !is_sharp(contact)) continue;
        const Vector3d point = common_point(contact);
        m.stick_a = b.orientation[contact.a].conjugate() * (point - b.position[contact.a]);
        m.stick_b = b.orientation[contact.b].conjugate() * (point - b.position[contact.b]);
    }
}

void remember_contacts(World& world) {
    world.contacts.found_before.swap(world.contacts.found);
    world.contacts.memory_before.swap(world.contacts.memory);
}

}  // namespace plumb
