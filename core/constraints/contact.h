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

#include <algorithm>

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

/// How old overlap is pushed out in a substep.
struct PushOut {
    double share = 0;  ///< of it that is removed
    double most = 0;   ///< no more of it counts than this [m]
};

/// Share that a substep of h [s] removes in an exact solution; `stiffness` is that of 10 ms or
/// longer. What pushes bodies apart stays in their velocities, and would throw them the higher the
/// shorter substeps are.
inline double push_out_share(double stiffness, double h) {
    constexpr double kUnhurried = 0.01;  // [s]
    return stiffness * std::min(1.0, h / kUnhurried);
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
