// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace plumb {

/// A piece of a line along which a convex function falls at the lower end and rises at the upper
/// one: where they are, and the slopes there.
struct Bracket {
    double low, high, at_low, at_high;

    /// Where a straight slope would be 0, and no nearer to the ends than this share of the piece.
    double guess(double inset) const {
        const double width = high - low;
        return std::clamp(low - at_low * width / (at_high - at_low), low + inset * width,
                          high - inset * width);
    }
    void narrow(double at, double slope) {
        if (slope > 0)
            high = at, at_high = slope;
        else
            low = at, at_low = slope;
    }
};

}  // namespace plumb
