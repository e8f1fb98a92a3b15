// SPDX-License-Identifier: MIT
/// Which of n things hang together, by the lowest of each set.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace plumb {

class DisjointSets {
public:
    /// n sets of one each.
    void reset(std::size_t n) {
        lower_.resize(n);
        std::iota(lower_.begin(), lower_.end(), 0u);
    }

    std::uint32_t lowest(std::uint32_t i) {
        while (lower_[i] != i) i = lower_[i] = lower_[lower_[i]];
        return i;
    }

    void unite(std::uint32_t a, std::uint32_t b) {
        a = lowest(a), b = lowest(b);
        lower_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> lower_;  ///< one of the same set, or itself
};

}  // namespace plumb
