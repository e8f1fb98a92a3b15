// SPDX-License-Identifier: MIT
/// From a back-end's normal to a full manifold of the true shapes: what ODE and Bullet share.
///
/// The back-end says that two convex parts are near, along which normal, and where (its witness).
/// The support faces of the true shapes are cut against each other along that normal and every gap
/// is measured anew. Where that is empty, or misses the depth that the normal implies, the witness
/// itself is kept and marked as a fallback.
#pragma once

#include "manifold/contact_list.h"

namespace plumb {

/// What a back-end said about a pair.
struct Witness {
    Vec3 normal;               ///< out of b towards a; need not be quite unit
    Vec3 point;                ///< somewhere between the surfaces [m]
    double gap;                ///< [m], negative when overlapping
    bool approximate = false;  ///< the back-end is known to err here
    bool shared = false;       ///< the normal is not the back-end's own but found beside it
};

inline constexpr int kMostPoints = 8;

/// What to do where the support faces do not face each other along the normal.
enum class Fallback {
    witness,  ///< keep the back-end's own point
    none      ///< no contact
};

/// Adds the contacts of a convex pair, a before b; counts into `stats`.
void build_manifold(ContactList& out, DetectStats& stats, const Part& a, const Part& b,
                    const Witness& witness, Fallback fallback = Fallback::witness);

/// Whether two points of the true shapes are as near along the unit normal n as their supports:
/// then n is the direction of the shortest way between parts that are apart.
bool gap_is_reached(const Part& a, const Part& b, Vec3 n);

/// Adds the contacts of a sharp pair along the unit normal n where the gap is reached; else none,
/// and returns false. `gap`: support_gap along n [m].
bool build_where_reached(ContactList& out, DetectStats& stats, const Part& a, const Part& b, Vec3 n,
                         double gap);

/// Adds one contact as the back-end gave it, sharp on both sides. `feature`: a key of what touches
/// there, 0 where the back-end does not say.
void add_raw(ContactList& out, DetectStats& stats, const Part& a, const Part& b,
             const Witness& witness, std::uint64_t feature);

}  // namespace plumb
