// SPDX-License-Identifier: MIT
/// A pivot of an elimination that rounding cannot make 0 or negative.
///
/// What an elimination subtracts from a diagonal entry is known to the entry's rounding, so a pivot
/// that is less than a few roundings of it is noise. Noise as a divisor throws bodies about, or is
/// 0; held up to the least that means anything, it lets the row be pushed too little instead.
#pragma once

#include "math/lanes.h"

#include <limits>

namespace plumb {

/// Share of a diagonal entry below which its pivot is rounding alone.
template <class T>
inline constexpr ScalarOf<T> kLeastPivot = 8 * std::numeric_limits<ScalarOf<T>>::epsilon();

/// The pivot that is left of a diagonal entry.
template <class T>
inline T held_pivot(const T& left, const T& entry) {
    return max(left, entry * T(kLeastPivot<T>));
}

}  // namespace plumb
