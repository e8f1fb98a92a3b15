// SPDX-License-Identifier: MIT
/// Contacts of the present step, and what is remembered of those of the step before.
#pragma once

#include <plumb/contact_set.h>

#include "math/types.h"
#include "world/kept_contacts.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// What a contact remembers while the same features touch: two lines of memory, the first with what
/// every step reads.
struct alignas(64) ContactMemory {
    double normal_impulse = 0;  ///< summed over both passes of the last substep [N s]
    Vector3d friction_impulse = Vector3d::Zero();  ///< world frame [N s]
    double gap = 0;              ///< of the step before, where it was solved exactly [m]
    float disputed_overlap = 0;  ///< sum of its island's when it began to be opened [m]
    bool sticks = false;
    bool exact = false;         ///< whether its impulses are those of an island solved exactly
    bool jammed = false;        ///< friction holds its overlap: an exact solution could not push it
                                ///< out, or left it as it is
    std::uint8_t disputed = 0;  ///< steps for which its island is (islands/island_effort.h)
    std::uint8_t settling = 0;  ///< steps for which it is solved to a finer tolerance (the same)
    std::uint8_t missed = 0;    ///< 1: its island misses Settings::accuracy; more: it waits for so
                                ///< long (islands/island_account.h)
    bool moved = false;         ///< and it moved when it was given up
    bool flush = false;         ///< it is with what lies below the plane of another
    bool ghost = false;         ///< and others ensure what it would (contacts/ghost_contacts.h)
    bool known = false;         ///< whether the step before had this very feature
    bool matched = false;  ///< whether it has impulses of the step before, its own or inherited
    Vector3d stick_a = Vector3d::Zero();  ///< points of a and b that met when it began to stick,
    Vector3d stick_b = Vector3d::Zero();  ///< in the bodies' frames [m]
    Vector3d rolling_impulse = Vector3d::Zero();  ///< torque of rolling and spinning friction, of
                                                  ///< islands solved exactly; world [N m s]
};
static_assert(sizeof(ContactMemory) == 128);

/// Contacts with what they remember; sorted by (a, b, feature).
struct RememberedContacts {
    std::vector<Contact> found;         ///< [contact]
    std::vector<ContactMemory> memory;  ///< [contact]
};

/// Contacts of bodies that sleep, with the pairs that they are of; columns as in ContactTable and
/// KeptContacts.
struct SleepingContacts : RememberedContacts {
    std::vector<ContactRide> rides;
    std::vector<KeptPair> pairs;
    std::vector<PairPose> poses;
};

/// The contacts of two bodies, which stand side by side in their table.
struct ContactPair {
    std::uint32_t a, b;          ///< bodies, a < b
    std::uint32_t first, count;  ///< its contacts
    bool stays = false;          ///< its contacts were in the table before, and ride on the bodies
};

/// What a walk needs to look at a pair as it was, while its contacts change.
struct PairBefore {
    RememberedContacts contacts;
    std::vector<std::uint8_t> used;  ///< whether one of now has taken over the memory
};

/// Where the points of a contact ride, for following it through substeps; body frames.
struct ContactTrack {
    Vector3d a, b;  ///< anchors [m]
    double share;   ///< of a's point in where the contact acts, in [0, 1]; the rest is b's
};

/// A circle that is the edge of a flat round end; body frame.
struct Rim {
    Vector3d centre = Vector3d::Zero(), axis = Vector3d::Zero();  ///< [m], unit
    double radius = 0;                                            ///< [m]; 0: none
};

/// The rim on which a contact lies, and whose it is.
struct ContactRim {
    Rim rim;
    std::uint32_t body = 0;
    bool runs = false;  ///< along the rim, as its deepest point does; else it rides on the body
};

/// What restitution does about a contact in a substep.
enum class Restitution : std::uint8_t {
    none,
    passing,  ///< it is still open, and bounces once it touches
    bouncing
};

/// Columns of one length: [contact], sorted by (a, b, feature), and below them what a detection
/// works with. The contacts and what they remember stay from step to step: those of pairs that
/// hardly moved are brought to the poses of the step where they stand.
struct ContactTable : RememberedContacts {
    std::vector<ContactPair> pairs;   ///< of the contacts, in their order
    std::vector<ContactTrack> track;  ///< only with more than one substep
    std::vector<ContactRim> rims;     ///< of radius 0 where a contact is on none; only where shapes
                                      ///< have rims
    std::vector<Vector3d> bend;   ///< mean velocity over the substep less that at its start [m/s];
                                  ///< empty with the paper's push, and before the first substep
    std::vector<double> gap;      ///< at the start of the substep [m]
    std::vector<Vector3d> point;  ///< where it acts at the start of the substep [m]
    std::vector<Restitution> restitution;  ///< of the substep; this and the next only where some
                                           ///< pair bounces
    std::vector<double> restitution_velocity;  ///< separating speed that it asks for [m/s]
    std::vector<std::uint8_t> bounced;         ///< whether a collision has consumed its restitution
    std::vector<Vector3d>
        anchor_slip;  ///< how far a sticking contact has left its anchors [m]; else empty

    RememberedContacts fresh;        ///< those that the collider reported in this step
    std::vector<PairBefore> before;  ///< [worker]
    std::vector<BodyFrame> frames;   ///< [body] at the poses now, for a walk along the pairs
    KeptContacts kept;

    std::uint64_t rejected =
        0;  ///< contacts left out since the start: a number not finite, or an id unknown

    /// Whether a contact comes through before it bounces.
    bool is_passing(std::size_t i) const {
        return !restitution.empty() && restitution[i] == Restitution::passing;
    }

    /// Decides about a contact's restitution in this substep; 0: it asks for none.
    void set_restitution(std::size_t i, double velocity) {
        restitution[i] = velocity > 0 ? Restitution::bouncing : Restitution::none;
        restitution_velocity[i] = velocity;
    }

    /// Adds a contact to the end of the pairs.
    void add_to_pairs(const Contact& c, std::uint32_t contact) {
        if (pairs.empty() || pairs.back().a != c.a || pairs.back().b != c.b)
            pairs.push_back({c.a, c.b, contact, 0});
        ++pairs.back().count;
    }
    /// Brings the pairs up to date where contacts were taken out.
    void list_pairs() {
        pairs.clear();
        for (std::uint32_t i = 0; i < found.size(); ++i) add_to_pairs(found[i], i);
    }

    static constexpr double kParting = 1e-9;  ///< velocity of what has bounced already [m/s]
};

/// The point at which a contact acts, half-way between the two surfaces [m].
inline Vector3d common_point(const Contact& c) {
    const Vector3d n = to_eigen(c.normal);
    return 0.5 * ((to_eigen(c.point_a) - c.radius_a * n) + (to_eigen(c.point_b) + c.radius_b * n));
}

/// Whether a contact's anchors are material points of the surface, so that sticking can remember
/// them.
inline bool is_sharp(const Contact& c) { return c.radius_a == 0 && c.radius_b == 0; }

}  // namespace plumb
