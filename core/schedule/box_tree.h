// SPDX-License-Identifier: MIT
/// Boxes in a tree whose nodes have eight children, to be found by other boxes.
///
/// Which boxes lie together is decided once, by their places at rest, for neighbours on a surface
/// remain neighbours wherever it goes; from then on the tree only follows them. Bounds are floats,
/// each a little further out than in truth, so that eight children are looked at side by side.
#pragma once

#include "math/types.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace plumb {

class BoxTree {
public:
    /// Boxes by their middles at rest; those of a group, which follow each other, are kept
    /// together.
    void build(const std::vector<Vector3d>& middles, const std::vector<std::uint32_t>& groups);

    /// Takes the places [low, high] of all boxes.
    void follow(const std::vector<Vector3d>& low, const std::vector<Vector3d>& high);

    /// Calls visit(box) for each box that meets [low, high], and for some that all but do, each
    /// once; their order tells nothing.
    template <class Visit>
    void each_near(const Vector3d& low, const Vector3d& high, Visit visit) const {
        if (order_.empty()) return;
        const Bounds negative = bounds_of(-high, -low);
        Limits limits;
        for (int k = 0; k < 6; ++k) limits.at[k] = Four{} - negative.at[k];
        look(0, 0, limits, visit);
    }

private:
    static constexpr std::uint32_t kChildren = 8;

    /// Lower bounds, then upper ones with the other sign.
    struct Bounds {
        float at[6];
    };
    using Four = float __attribute__((vector_size(16)));
    /// Upper bounds of a box, then lower ones with the other sign: what its own bounds exceed, is
    /// apart from it.
    struct Limits {
        Four at[6];
    };
    struct alignas(64) Node {
        float at[6][kChildren];  ///< as of Bounds
    };

    static Bounds bounds_of(const Vector3d& low, const Vector3d& high) {
        constexpr double kFar = 1e38;
        constexpr float kOut = 2e-7f, kLeast = 1e-30f;  // more than a rounding
        Bounds b;
        for (int k = 0; k < 6; ++k) {
            const double x = k < 3 ? low[k] : -high[k - 3];
            const auto near = static_cast<float>(std::clamp(x, -kFar, kFar));
            b.at[k] = near - std::abs(near) * kOut - kLeast;
        }
        return b;
    }

    /// Which children of a node are not certainly apart from a box: one bit each.
    static std::uint32_t near(const Node& node, const Limits& limits) {
        using Bits = std::int32_t __attribute__((vector_size(16)));
        Bits found{};
        for (std::uint32_t half = 0; half < 2; ++half) {
            Bits apart{};
            for (int k = 0; k < 6; ++k) {
                Four bound;
                __builtin_memcpy(&bound, node.at[k] + 4 * half, sizeof bound);
                apart |= bound > limits.at[k];
            }
            found |= ~apart & (half == 0 ? Bits{1, 2, 4, 8} : Bits{16, 32, 64, 128});
        }
        std::uint64_t pairs[2];
        __builtin_memcpy(pairs, &found, sizeof pairs);
        const std::uint64_t both = pairs[0] | pairs[1];
        return static_cast<std::uint32_t>(both | both >> 32);
    }

    template <class Visit>
    void look(std::uint32_t level, std::uint32_t node, const Limits& limits, Visit& visit) const {
        const std::uint32_t end = level + 1 < levels_.size()
                                      ? levels_[level + 1].count
                                      : static_cast<std::uint32_t>(order_.size());
        std::uint32_t found = near(nodes_[levels_[level].first + node], limits);
        for (; found != 0; found &= found - 1) {
            const std::uint32_t child =
                kChildren * node + static_cast<std::uint32_t>(std::countr_zero(found));
            if (child >= end) return;  // a box as large as can be meets empty places too
            if (level + 1 < levels_.size())
                look(level + 1, child, limits, visit);
            else
                visit(order_[child]);
        }
    }

    void split(const std::vector<Vector3d>& middles, const std::vector<std::uint32_t>& groups,
               std::uint32_t first, std::uint32_t last);
    void set(std::uint32_t level, std::uint32_t child, const Bounds& bounds);
    Bounds bounds_of_node(const Node& node) const;

    /// Nodes of a depth, from the root on.
    struct Level {
        std::uint32_t first, count;  ///< in nodes_
    };
    std::vector<Level> levels_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;  ///< [place below the last level] box
};

}  // namespace plumb
