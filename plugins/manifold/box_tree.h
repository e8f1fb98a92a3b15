// SPDX-License-Identifier: MIT
/// A tree of bounding volumes over boxes that stand still: the triangles of a mesh, the parts of a
/// scene at one moment.
///
/// In goes one box an item; out come the items whose boxes meet a box, those near a point, and
/// those on a ray. The order of a walk depends on the boxes alone.
#pragma once

#include "manifold/aabb.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace plumb {

/// Square of the distance of two boxes, 0 where they meet [m²].
double squared_distance(const Aabb& a, const Aabb& b);

/// A half-line, with the reciprocals of its direction.
struct Ray {
    Vec3 origin;     ///< [m]
    Vec3 direction;  ///< unit
    Vec3 one_over;   ///< 1 / direction, infinite where that is 0
};
Ray make_ray(Vec3 origin, Vec3 direction);

/// Where a ray of any length enters a box [m]: 0 where it begins inside, infinite where it misses.
double entry(const Ray& ray, const Aabb& box);

class BoxTree {
public:
    /// `boxes` must be finite.
    explicit BoxTree(const std::vector<Aabb>& boxes = {});

    bool empty() const { return nodes_.empty(); }

    /// Bounds of all items. Not for an empty tree.
    const Aabb& bounds() const { return nodes_[0].box; }

    /// Calls visit(item) for every item whose box meets `box`.
    template <class Visit>
    void overlapping(const Aabb& box, Visit&& visit) const {
        const auto reach = [&](const Aabb& other) { return overlap(box, other) ? 0.0 : kFar; };
        walk(
            reach, [] { return 0.0; }, visit);
    }

    /// Calls visit(item) for items no farther from `box` than limit() [m²], near ones first;
    /// `limit` may shrink under way.
    template <class Limit, class Visit>
    void near(const Aabb& box, Limit&& limit, Visit&& visit) const {
        walk([&](const Aabb& other) { return squared_distance(box, other); }, limit, visit);
    }

    /// Calls visit(item) for items whose boxes the ray enters within limit() [m], which may shrink.
    template <class Limit, class Visit>
    void along(const Ray& ray, Limit&& limit, Visit&& visit) const {
        walk([&](const Aabb& box) { return entry(ray, box); }, limit, visit);
    }

private:
    static constexpr double kFar = std::numeric_limits<double>::infinity();

    struct Node {
        Aabb box;
        std::uint32_t first;  ///< of its items; of an inner node: its left child, the right is next
        std::uint32_t count;  ///< 0: an inner node
    };

    void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

    /// Depth first, the nearer child before the other; leaves out what reaches beyond the limit.
    template <class Reach, class Limit, class Visit>
    void walk(Reach&& reach, Limit&& limit, Visit&& visit) const {
        struct Open {
            std::uint32_t node;
            double reach;
        };
        const auto wanted = [&](double distance) { return distance < kFar && distance <= limit(); };
        Open open[2 * kDeepest];
        int count = 0;
        if (!nodes_.empty()) open[count++] = {0, reach(nodes_[0].box)};
        while (count > 0) {
            const Open next = open[--count];
            if (!wanted(next.reach)) continue;
            const Node& node = nodes_[next.node];
            if (node.count > 0) {
                for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                    if (wanted(reach(boxes_[i]))) visit(items_[i]);
                continue;
            }
            const Open left{node.first, reach(nodes_[node.first].box)};
            const Open right{node.first + 1, reach(nodes_[node.first + 1].box)};
            const bool left_first = left.reach <= right.reach;
            open[count++] = left_first ? right : left;
            open[count++] = left_first ? left : right;
        }
    }

    static constexpr int kDeepest = 40;  ///< halving 2³² items goes no deeper

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> items_;  ///< in the order of the leaves
    std::vector<Aabb> boxes_;           ///< the same order
    std::vector<Vec3> middles_;         ///< [item], while building
};

}  // namespace plumb
