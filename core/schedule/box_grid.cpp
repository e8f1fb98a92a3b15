// SPDX-License-Identifier: MIT
#include "schedule/box_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace plumb {

namespace {

/// Side of a cell over the mean extent of a box: most boxes are in one or two cells along each
/// axis.
constexpr double kSidePerExtent = 1;

}  // namespace

void BoxGrid::build(const std::vector<Vector3d>& low, const std::vector<Vector3d>& high) {
    const auto n = static_cast<std::uint32_t>(low.size());
    double sum = 0;
    for (std::uint32_t i = 0; i < n; ++i) sum += (high[i] - low[i]).maxCoeff();
    side_ = n > 0 && sum > 0 && std::isfinite(sum) ? kSidePerExtent * sum / n : 1;
    const std::uint32_t buckets = std::bit_ceil(std::max(2 * n, 16u));
    mask_ = buckets - 1;
    large_.clear();
    is_large_.assign(n, 0);
    first_.assign(buckets + 1, 0);
    if (seen_.size() != n) seen_.assign(n, 0), stamp_ = 0;
    cells_.clear(), ends_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool few = each_cell(low[i], high[i],
                                   [&](std::uint32_t b) { ++first_[b + 1], cells_.push_back(b); });
        if (!few) large_.push_back(i), is_large_[i] = 1;
        ends_[i] = static_cast<std::uint32_t>(cells_.size());
    }
    for (std::uint32_t b = 0; b < buckets; ++b) first_[b + 1] += first_[b];
    if (boxes_.capacity() < first_[buckets]) {
        boxes_.reserve(2 * std::size_t(first_[buckets]));
        bounds_.reserve(2 * std::size_t(first_[buckets]));
        cells_.reserve(2 * std::size_t(first_[buckets]));
    }
    large_.reserve(n);
    boxes_.resize(first_[buckets]), bounds_.resize(first_[buckets]);
    // each bucket's end moves down to its beginning while it fills
    for (std::uint32_t i = n; i-- > 0;) {
        const Bounds bounds = bounds_of(low[i], high[i]);
        for (std::uint32_t k = i > 0 ? ends_[i - 1] : 0; k < ends_[i]; ++k) {
            const std::uint32_t place = --first_[cells_[k] + 1];
            boxes_[place] = i, bounds_[place] = bounds;
        }
    }
    for (std::uint32_t b = 0; b < buckets; ++b) first_[b] = first_[b + 1];
    first_[buckets] = static_cast<std::uint32_t>(boxes_.size());
}

}  // namespace plumb
