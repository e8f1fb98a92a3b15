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

    static constexpr std::uint32_t kChildren = 8;

    /// Boxes lie at these places, in leaves of kChildren of them.
    std::uint32_t size() const { return static_cast<std::uint32_t>(order_.size()); }
    std::uint32_t box_at(std::uint32_t place) const { return order_[place]; }

    /// Takes a box [low, high]; and once all have been, what lies above them.
    void set(std::uint32_t place, const Vector3d& low, const Vector3d& high) {
        set(static_cast<std::uint32_t>(levels_.size()) - 1, place, bounds_of(low, high));
    }
    void close();

    /// Calls visit(box) for each box that meets [low, high], and for some that all but do, each
    /// once; their order tells nothing.
    template <class Visit>
    void each_near(const Vector3d& low, const Vector3d& high, Visit visit) const {
        each_leaf_near(low, high, [&](std::uint32_t first, std::uint32_t found) {
            for (; found != 0; found &= found - 1)
                visit(order_[first + static_cast<std::uint32_t>(std::countr_zero(found))]);
        });
    }

    /// The same, leaf by leaf: calls visit(place, found) with its first place, and one bit for each
    /// of its boxes.
    template <class Visit>
    void each_leaf_near(const Vector3d& low, const Vector3d& high, Visit visit) const {
        if (order_.empty()) return;
        const Bounds negative = bounds_of(-high, -low);
        Limits limits;
        for (int k = 0; k < 6; ++k) limits.at[k] = Four{} - negative.at[k];
        look(0, 0, limits, visit);
    }

private:
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
        std::uint32_t found = near(nodes_[levels_[level].first + node], limits);
        const bool is_leaf = level + 1 == levels_.size();
        const std::uint32_t first = kChildren * node,
                            end = is_leaf ? size() : levels_[level + 1].count;
        // what is no number is not beyond empty places either
        if (end - first < kChildren) found &= (1u << (end - first)) - 1;
        if (is_leaf) {
            if (found != 0) visit(first, found);
            return;
        }
        for (; found != 0; found &= found - 1)
            look(level + 1, first + static_cast<std::uint32_t>(std::countr_zero(found)), limits,
                 visit);
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
