// SPDX-License-Identifier: MIT
/// Contacts that are kept from step to step while the two bodies of a pair stand still to each
/// other.
#pragma once

#include <plumb/contact_set.h>

#include "math/types.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// A pair as it was when its narrow phase ran.
struct KeptPair {
    std::uint32_t a, b;          ///< bodies, a < b
    std::uint32_t first, count;  ///< its contacts in KeptContacts::pool
    bool fresh;                  ///< its narrow phase runs in this step
    double margin;               ///< gaps up to it were asked for [m]
    Vector3d offset;             ///< the smaller body's centre of mass in the other's frame [m]
    Quaterniond turn;            ///< the smaller body's frame → the other's
    double moved = 0;            ///< bound on how far its points have come since [m]
};

struct KeptContacts {
    std::vector<KeptPair> pairs;         ///< sorted by (a, b); those without a contact as well
    std::vector<KeptPair> pairs_before;  ///< of the step before
    std::vector<Contact> pool;           ///< point_a and normal in a's frame, point_b in b's frame
    std::uint64_t reused = 0;            ///< contacts that were kept in this step
};

}  // namespace plumb
