// SPDX-License-Identifier: MIT
/// Boxes sorted into the cells of a grid, to be found by other boxes. Its memory is reused.
#pragma once

#include "math/types.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace plumb {

class BoxGrid {
public:
    /// Sorts boxes [low, high] into cells of a side that suits their mean extent.
    void build(const std::vector<Vector3d>& low, const std::vector<Vector3d>& high);

    /// Calls visit(box) for each box that meets [low, high], and for some others, each once.
    template <class Visit>
    void each_near(const Vector3d& low, const Vector3d& high, Visit visit) {
        for (const std::uint32_t box : large_) visit(box);
        ++stamp_;
        const Bounds here = bounds_of(-high, -low);
        const bool few = each_cell(low, high, [&](std::uint32_t bucket) {
            for (std::uint32_t i = first_[bucket]; i < first_[bucket + 1]; ++i) {
                if (apart(bounds_[i], here) || seen_[boxes_[i]] == stamp_) continue;
                seen_[boxes_[i]] = stamp_;
                visit(boxes_[i]);
            }
        });
        if (few) return;
        for (std::uint32_t box = 0; box < seen_.size(); ++box)
            if (!is_large_[box]) visit(box);
    }

private:
    struct Cell {
        std::int64_t x, y, z;
    };
    Cell cell_of(const Vector3d& p) const {
        const auto at = [&](double x) {
            const double cell = std::clamp(x / side_, -1e15, 1e15);
            const auto whole = static_cast<std::int64_t>(cell);
            return whole - (cell < static_cast<double>(whole));
        };
        return {at(p.x()), at(p.y()), at(p.z())};
    }

    /// Lower bounds and upper ones with the other sign, in a register of floats, each a little
    /// further out than in truth; lanes to spare are 0.
    struct alignas(32) Bounds {
        float at[8];
    };
    static Bounds bounds_of(const Vector3d& low, const Vector3d& high) {
        constexpr float kOut = 2e-7f, kLeast = 1e-30f;  // more than a rounding
        Bounds b{};
        for (int k = 0; k < 3; ++k) {
            const auto x = static_cast<float>(low[k]), y = static_cast<float>(-high[k]);
            b.at[k] = x - std::abs(x) * kOut - kLeast;
            b.at[4 + k] = y - std::abs(y) * kOut - kLeast;
        }
        return b;
    }
    /// Whether a box is certainly apart from another one whose bounds are told with the other sign:
    /// where a lower bound is above the other's upper one, their sum is positive.
    static bool apart(const Bounds& box, const Bounds& negative) {
        using Four = float __attribute__((vector_size(16)));
        using Pair = std::int64_t __attribute__((vector_size(16)));
        Four a[2], b[2];
        __builtin_memcpy(a, &box, sizeof a);
        __builtin_memcpy(b, &negative, sizeof b);
        const auto above = (a[0] + b[0] > Four{}) | (a[1] + b[1] > Four{});
        Pair any;
        __builtin_memcpy(&any, &above, sizeof any);
        return (any[0] | any[1]) != 0;
    }

    std::uint32_t bucket_of(std::int64_t x, std::int64_t y, std::int64_t z) const {
        const auto mixed = static_cast<std::uint64_t>(x) * 73856093u ^
                           static_cast<std::uint64_t>(y) * 19349663u ^
                           static_cast<std::uint64_t>(z) * 83492791u;
        return static_cast<std::uint32_t>(mixed) & mask_;
    }

    /// Calls visit(bucket) for each cell of a box; false where those are too many.
    template <class Visit>
    bool each_cell(const Vector3d& low, const Vector3d& high, Visit visit) const {
        const Vector3d cells = (high - low) / side_ + Vector3d::Ones();
        if (!(cells.prod() <= kMostCells)) return false;
        const Cell a = cell_of(low), b = cell_of(high);
        for (std::int64_t x = a.x; x <= b.x; ++x)
            for (std::int64_t y = a.y; y <= b.y; ++y)
                for (std::int64_t z = a.z; z <= b.z; ++z) visit(bucket_of(x, y, z));
        return true;
    }

    /// A box in more cells than this is shown to everybody instead.
    static constexpr double kMostCells = 64;

    double side_ = 1;
    std::uint32_t mask_ = 0;
    std::uint64_t stamp_ = 0;
    std::vector<std::uint32_t> first_, boxes_, large_;
    std::vector<Bounds> bounds_;        ///< of boxes_
    std::vector<std::uint32_t> cells_;  ///< buckets, box by box, which end at
    std::vector<std::uint32_t> ends_;   ///< [box]
    std::vector<std::uint8_t> is_large_;
    std::vector<std::uint64_t> seen_;
};

}  // namespace plumb
