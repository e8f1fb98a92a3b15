// SPDX-License-Identifier: MIT
/// Contacts of pairs that hardly moved are kept instead of being detected again.
///
/// The collider's broad phase names its candidates. Of these, a pair is left out of the narrow
/// phase while no point of its smaller body has moved by more than d = Settings::reuse_distance
/// against the other body since the narrow phase last ran on it. Its contacts ride on the bodies
/// meanwhile, which keeps
///
///   gaps        exact to first order: off by at most d²/2r for features of size r,
///   outlines    of contact areas within d,
///   new points  from being found at a gap of margin − 2 d at the latest; the first of a pair, at
///               half of the margin, and before half of their gap may close in a step by what the
///               two do themselves. What a third body knocks into them in that step is not known.
///
/// No error adds up, because the motion is measured from the pose of the last narrow phase.
/// What is round rolls on its contacts, and where these are solved exactly it moves by as little as
/// d/10⁴ until it gets new ones: points and normals that lag behind would push it on.
#pragma once

#include "contacts/pose_change.h"
#include "world/world.h"

#include <plumb/proximity.h>

#include <vector>

namespace plumb {

/// How a body moves, and what of it rolls: side by side, for pairs name bodies in any order.
struct BodyMotion {
    double travel;      ///< how far a point of it may come in the step [m]
    double sweep;       ///< of that, what the margin does not cover [m]
    PoseChange change;  ///< since the detection before
    bool is_round, has_rim;
    bool is_still;  ///< nothing moves it (world/sleep.h)
};

/// What a question to the collider needs to leave out pairs.
struct ReuseContext {
    World* world;
    const std::vector<BodyMotion>* motions;  ///< [body]
    bool asked = false;                      ///< whether the collider has asked
};

/// Asks for the contacts of all pairs but those that are kept. `context` must outlive the call.
PairFilter reuse_filter(ReuseContext& context);

/// Nothing is kept: before a detection that does not ask, and after one that failed, whose answer
/// must not live on.
void forget_kept_contacts(World& world);

}  // namespace plumb
