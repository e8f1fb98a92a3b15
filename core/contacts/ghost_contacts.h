// SPDX-License-Identifier: MIT
/// Ghost contacts: with edges that cannot be reached.
///
/// What slides or rolls over slabs that lie flush comes near the edge of the next one before it is
/// over it. The closest points are then on that edge, and a contact along the line between them
/// would brake a wheel and stop a box. But a contact with the slab beneath has a plane that the
/// body, if it is convex, may not pass within the step, and the next slab is wholly below that
/// plane. Where such contacts hold the same point of the body, nothing is left to do for the one at
/// the edge: it is a ghost, which stays in the table and never closes. Where they hold other
/// points, it is turned: it holds its point above the same plane. Of what is concave, each convex
/// part is judged by its own contacts. A ghost may not rest on another one.
///
/// A contact of bodies that cannot meet within the step does not close in it either
/// (contacts/contact_reach.h).
#pragma once

#include "schedule/workers.h"
#include "world/world.h"

#include <cstdint>
#include <span>
#include <vector>

namespace plumb {

class GhostContacts {
public:
    /// Once a step, before contacts are followed: judges those that were detected anew, into
    /// ContactMemory::ghost, and turns some. Those of pairs that were kept stay what they were.
    void find(World& world, Workers& workers);

    /// In each substep, after the gaps are measured: nothing closes a ghost's.
    void keep_open(ContactTable& contacts) const;

private:
    enum class Verdict { real, ghost, turned };

    /// What a contact of a body is with, and the plane there: a line of memory, for each contact of
    /// a body that comes is held against all of them.
    struct alignas(64) Plane {
        Vector3d normal;                 ///< out of the other body
        Vector3d surface;                ///< point of the other's surface [m]
        std::uint32_t other;             ///< body
        std::uint32_t part, other_part;  ///< of the body that touches, and of the other
        std::uint32_t contact;

        Plane() = default;
        Plane(const Contact& of, std::uint32_t body, std::uint32_t contact);
    };

    void choose(World& world);
    void list_contacts(const World& world, Workers& workers);
    void judge_one(World& world, std::uint32_t contact);
    Verdict judge(World& world, std::uint32_t contact, std::uint32_t body);
    std::span<const Plane> planes_of(std::uint32_t body) const;
    void turn(World& world, std::uint32_t contact, std::uint32_t body, const Vector3d& n,
              const Vector3d& held, double gap);

    Verdict judge_above(World& world, const Plane& at, const Plane& plane, std::uint32_t body);
    static bool stands_out(const World& world, const Plane& at, const Plane& plane, double flush);
    static bool lies_below(const World& world, const Plane& at, const Plane& plane, double flush);

    /// A contact by how far it is from just touching.
    struct Touch {
        double distance;  ///< [m]
        std::uint32_t contact;
        bool operator<(const Touch& other) const {
            return distance < other.distance ||
                   (distance == other.distance && contact < other.contact);
        }
    };

    std::vector<std::uint32_t> first_;    ///< [body] in touches_ and planes_; one more at the end
    std::vector<Touch> touches_;          ///< of the bodies that are listed
    std::vector<Plane> planes_;           ///< of these, as the body sees them
    std::vector<std::uint8_t> listed_;    ///< [body] whether its contacts are
    std::vector<std::uint32_t> judged_;   ///< contacts
    std::vector<std::uint8_t> is_ghost_;  ///< [contact]
    std::vector<std::uint8_t> needed_;    ///< [contact] whether a ghost rests on it
    std::vector<std::uint32_t> beneath_;  ///< of the body in question, in one plane
    std::vector<std::uint32_t> ghosts_;   ///< contacts
};

}  // namespace plumb
