// SPDX-License-Identifier: MIT
/// How a quantity spreads over millions of values, in constant memory.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace plumb {

/// Counts values, at least 0, in bins of 2 % of their size, from 1e-18 to 1e6; what is smaller
/// counts as 0. Values that are not finite count as the largest.
class Spread {
public:
    void add(double value) {
        ++count_;
        largest_ = std::max(largest_, std::isfinite(value) ? value : kHigh);
        ++bins_[bin_of(value)];
    }

    std::uint64_t count() const { return count_; }
    double largest() const { return largest_; }

    /// A value that the share p in [0, 1] of the values does not exceed, by at most 2.4 % too
    /// large; 0 of none.
    double quantile(double p) const {
        const auto wanted = static_cast<std::uint64_t>(std::ceil(p * static_cast<double>(count_)));
        std::uint64_t seen = 0;
        for (std::size_t i = 0; i < kBins; ++i)
            if ((seen += bins_[i]) >= wanted && seen > 0) return std::min(largest_, top_of(i));
        return largest_;
    }

private:
    static constexpr int kADecade = 100;
    static constexpr double kLow = 1e-18, kHigh = 1e6;
    static constexpr std::size_t kBins = 24 * kADecade + 1;

    static std::size_t bin_of(double value) {
        if (value < kLow) return 0;
        if (!(value < kHigh)) return kBins - 1;
        const double decades = std::log10(value / kLow);
        return std::min(kBins - 1, 1 + static_cast<std::size_t>(kADecade * decades));
    }
    static double top_of(std::size_t bin) {
        return bin == 0 ? 0 : kLow * std::pow(10.0, static_cast<double>(bin) / kADecade);
    }

    std::array<std::uint32_t, kBins> bins_{};
    std::uint64_t count_ = 0;
    double largest_ = 0;
};

}  // namespace plumb
