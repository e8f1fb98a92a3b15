// SPDX-License-Identifier: MIT
/// A chain of N links of one length and weight that hangs between two hooks of one height: the i-th
/// climbs by tan θᵢ = (i − (N − 1)/2) w/H, w a link's weight, H the level part of the force, which
/// the span gives. Links may stretch, by `softness` where they bear a link's weight.
#pragma once

#include "math/types.h"

#include <cmath>

namespace plumb::study {

class Catenary {
public:
    Catenary(int links, double link, double span, double softness = 0)
        : links_(links), link_(link), span_(span), softness_(softness), share_(found_share()) {}

    /// Unit vector along a link.
    Vector3d along(int i) const {
        const double slope = tangent(i, share_), level = 1 / std::hypot(1, slope);
        return {level, slope * level, 0};
    }
    double length(int i) const { return length(i, share_); }  ///< [m]
    /// Where a link begins; the first does at the origin [m].
    Vector3d begin(int i) const {
        Vector3d sum = Vector3d::Zero();
        for (int k = 0; k < i; ++k) sum += length(k) * along(k);
        return sum;
    }
    Vector3d middle(int i) const { return begin(i) + 0.5 * length(i) * along(i); }  ///< [m]
    /// Force at a hook over a link's weight, where the outermost links bear half of their own.
    double pull() const { return std::hypot(0.5 * links_, 1 / share_); }

private:
    double tangent(int i, double share) const { return (i - 0.5 * (links_ - 1)) * share; }
    double length(int i, double share) const {
        return link_ * (1 + softness_ * std::hypot(1, tangent(i, share)) / share);
    }
    double spanned(double share) const {
        double sum = 0;
        for (int i = 0; i < links_; ++i) sum += length(i, share) / std::hypot(1, tangent(i, share));
        return sum;
    }
    /// w/H, by bisection.
    double found_share() const {
        double low = 0, high = 10;
        for (int i = 0; i < 100; ++i) {
            const double middle = 0.5 * (low + high);
            (spanned(middle) > span_ ? low : high) = middle;
        }
        return low;
    }

    int links_;
    double link_, span_, softness_, share_;
};

}  // namespace plumb::study
