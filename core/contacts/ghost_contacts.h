// SPDX-License-Identifier: MIT
/// Ghost contacts: with edges that cannot be reached.
///
/// What slides or rolls over slabs that lie flush comes near the edge of the next one before it is
/// over it. The closest points are then on that edge, and a contact along the line between them
/// would brake a wheel and stop a box. But contacts with the slab beneath hold the same point of
/// the body above a plane, and the next slab is wholly below that plane: what those ensure, nothing
/// can collide with. A contact of which this is true stays in the table, and never closes.
///
/// It may not rest on another ghost, and the plane is one for a step: as the others' normals are.
#pragma once

#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

class GhostContacts {
public:
    /// Once a step, into ContactMemory::ghost: which of the contacts that came with it are ghosts.
    /// Those of pairs that were kept stay what they were.
    void find(World& world);

    /// In each substep, after the gaps are measured: nothing closes a ghost's.
    void keep_open(ContactTable& contacts) const;

private:
    void judge_those_that_came(World& world);
    void list_contacts(const World& world);
    bool is_ghost(const World& world, std::uint32_t contact, std::uint32_t body);

    std::vector<std::uint32_t> first_;     ///< [body] in contacts_; one more at the end
    std::vector<std::uint32_t> contacts_;  ///< of the bodies that have a contact that came
    std::vector<std::uint8_t> came_;       ///< [body] whether it has one
    std::vector<std::uint8_t> needed_;     ///< [contact] whether a ghost rests on it
    std::vector<std::uint32_t> beneath_;   ///< of the body in question, in one plane
    std::vector<std::uint32_t> ghosts_;    ///< contacts
};

}  // namespace plumb
