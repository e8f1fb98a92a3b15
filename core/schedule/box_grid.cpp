// SPDX-License-Identifier: MIT
#include "schedule/box_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace plumb {
namespace {

/// A box in more cells than this is shown to every point instead.
constexpr double kMostCells = 64;

}  // namespace

BoxGrid::Cell BoxGrid::cell_of(const Vector3d& p) const {
    const auto at = [&](double x) {
        return static_cast<std::int64_t>(std::floor(std::clamp(x / side_, -1e15, 1e15)));
    };
    return {at(p.x()), at(p.y()), at(p.z())};
}

std::uint32_t BoxGrid::bucket_of(const Cell& c) const {
    const auto mixed = static_cast<std::uint64_t>(c.x) * 73856093u ^
                       static_cast<std::uint64_t>(c.y) * 19349663u ^
                       static_cast<std::uint64_t>(c.z) * 83492791u;
    return static_cast<std::uint32_t>(mixed) & mask_;
}

template <class Visit>
bool BoxGrid::each_cell(const Vector3d& low, const Vector3d& high, Visit visit) const {
    const Vector3d cells = (high - low) / side_ + Vector3d::Ones();
    if (!(cells.prod() <= kMostCells)) return false;
    const Cell a = cell_of(low), b = cell_of(high);
    for (std::int64_t x = a.x; x <= b.x; ++x)
        for (std::int64_t y = a.y; y <= b.y; ++y)
            for (std::int64_t z = a.z; z <= b.z; ++z) visit(bucket_of({x, y, z}));
    return true;
}

void BoxGrid::build(const std::vector<Vector3d>& low, const std::vector<Vector3d>& high) {
    const auto n = static_cast<std::uint32_t>(low.size());
    double sum = 0;
    for (std::uint32_t i = 0; i < n; ++i) sum += (high[i] - low[i]).maxCoeff();
    side_ = n > 0 && sum > 0 && std::isfinite(sum) ? sum / n : 1;
    const std::uint32_t buckets = std::bit_ceil(std::max(2 * n, 16u));
    mask_ = buckets - 1;
    large_.clear();
    first_.assign(buckets + 1, 0);
    seen_.assign(n, 0);
    stamp_ = 0;
    for (std::uint32_t i = 0; i < n; ++i)
        if (!each_cell(low[i], high[i], [&](std::uint32_t b) { ++first_[b + 1]; }))
            large_.push_back(i);
    for (std::uint32_t b = 0; b < buckets; ++b) first_[b + 1] += first_[b];
    boxes_.resize(first_[buckets]);
    // each bucket's end moves down to its beginning while it fills
    for (std::uint32_t i = n; i-- > 0;)
        each_cell(low[i], high[i], [&](std::uint32_t b) { boxes_[--first_[b + 1]] = i; });
    for (std::uint32_t b = 0; b < buckets; ++b) first_[b] = first_[b + 1];
    first_[buckets] = static_cast<std::uint32_t>(boxes_.size());
}

}  // namespace plumb
