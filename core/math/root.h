// SPDX-License-Identifier: MIT
/// The n-th root in arithmetic of its own: the system's pow differs in the last bit between
/// processors, and runs with it.
#pragma once

#include <cstdint>

namespace plumb {

/// x with xⁿ = a, for a in [0, 1] and n ≥ 1: Newton's steps from 1, which come down to the root.
inline double root_of_share(double a, std::uint32_t n) {
    if (a <= 0) return 0;
    double x = 1;
    for (int round = 0; round < 200; ++round) {
        double power = 1;
        for (std::uint32_t i = 1; i < n; ++i) power *= x;
        const double next = x - (x - a / power) / n;
        if (!(next < x)) break;
        x = next;
    }
    return x;
}

}  // namespace plumb
