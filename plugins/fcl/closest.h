// SPDX-License-Identifier: MIT
/// FCL's signed distance of two convex parts.
#pragma once

#include "manifold/manifold.h"

namespace plumb::by_fcl {

/// What FCL said.
enum class Answer {
    found,   ///< the witness is filled in
    silent,  ///< it gave up, threw, or names no direction
};

/// Deepest or nearest points of two parts, a before b; neither is a plane or a mesh.
Answer signed_distance(Witness& witness, const Part& a, const Part& b);

}  // namespace plumb::by_fcl
