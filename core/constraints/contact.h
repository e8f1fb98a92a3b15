// SPDX-License-Identifier: MIT
/// Contact along the normal (§6): C(a, b) = nᵀ(a − b) ≥ 0, solved for velocities and for positions.
///
///   n  normal, out of b towards a
///   c  gap nᵀ(a − b) now [m]; negative = overlap
///   d  gap before the first iteration [m], at most 0
///   s  share of the old overlap removed per iteration, in (0, 1]
///   u  velocity of a against b along n [m/s]; negative = approaching
///   λ  summed impulse [N s], never negative: a contact pushes and does not pull
#pragma once

#include "math/lanes.h"

namespace plumb {

/// Gap that one position iteration shall close [m] (§6, intersection resolution).
///
/// Overlap made since (c < d) goes in full, old overlap by s only, so a deep start cannot throw
/// bodies apart. May be positive: the caller keeps the summed push from turning into a pull.
template <class T>
inline T gap_to_solve(const T& c, const T& d, const T& s) {
    return min(T(0), c - d) + s * max(c, d);
}

/// The same where both passes share one push: the gap at the end of the substep shall be d (1 − s),
/// from either side.
///
/// A departure from §6: whoever only ever pushes adds to the push that the velocity pass found,
/// substep after substep, and tall stacks begin to jump. Here s is the share of a whole substep.
template <class T>
inline T gap_below(const T& c, const T& d, const T& s) {
    return (c - d) + s * d;
}

/// Part of an overlap that is left alone in this substep [m], at most 0: no more than `most` [m] is
/// pushed out.
template <class T>
inline T overlap_left(const T& gap, const T& most) {
    return min(T(0), gap + most);
}

/// Adds an impulse to λ, keeps the sum at `least` or above (§6: the sum stays repulsive), and
/// returns what was added.
template <class T>
inline T push(T& lambda, const T& impulse, const T& least) {
    const T before = lambda;
    lambda = max(least, before + impulse);
    return lambda - before;
}

}  // namespace plumb
