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
///   new points  from being found at a gap of margin − d at the latest,
///
/// and no error adds up, because the motion is measured from the pose of the last narrow phase.
/// What is round rolls on its contacts, and where these are solved exactly it moves by as little as
/// d/10⁴ until it gets new ones: points and normals that lag behind would push it on.
#pragma once

#include "contacts/pose_change.h"
#include "world/world.h"

#include <plumb/proximity.h>

#include <vector>

namespace plumb {

/// What a question to the collider needs to leave out pairs.
struct ReuseContext {
    World* world;
    const std::vector<double>* sweeps;       ///< [body] [m]
    const std::vector<PoseChange>* changes;  ///< [body]
};

/// Asks for the contacts of all pairs but those that are kept. `context` must outlive the call.
PairFilter reuse_filter(ReuseContext& context);

/// Puts the kept contacts, at the poses now, among those that were found; remembers the latter.
/// Returns how many were left out, because they are of pairs that were not asked about.
std::uint32_t merge_kept_contacts(World& world);

/// Nothing is kept: after a detection that failed, whose answer must not live on.
void forget_kept_contacts(World& world);

}  // namespace plumb
