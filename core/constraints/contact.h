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

/// What one position iteration shall close (§6, intersection resolution), in two parts [m].
template <class T>
struct GapParts {
    T fresh;     ///< overlap made in this substep, at most 0: it goes in full
    T recovery;  ///< share s of the old overlap: a deep start cannot throw bodies apart
};

/// c_modified = min(0, c − d) + s max(c, d). The recovery may be positive: the caller keeps the summed push from
/// turning into a pull.
template <class T>
inline GapParts<T> gap_to_solve(const T& c, const T& d, const T& s) {
    return {min(T(0), c - d), s * max(c, d)};
}

/// Part of an overlap that is left alone in this substep [m], at most 0: no more than `most` [m] is pushed out.
template <class T>
inline T overlap_left(const T& gap, const T& most) {
    return min(T(0), gap + most);
}

/// Adds an impulse to λ, keeps the sum at `least` or above (§6: the sum stays repulsive), and returns what was added.
template <class T>
inline T push(T& lambda, const T& impulse, const T& least) {
    const T before = lambda;
    lambda = max(least, before + impulse);
    return lambda - before;
}

}  // namespace plumb
