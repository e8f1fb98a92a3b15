// SPDX-License-Identifier: MIT
#include "manifold/box_tree.h"

#include <numeric>

namespace plumb {
namespace {

constexpr std::uint32_t kLeaf = 4;  ///< items of a leaf, at most

Aabb joined(const Aabb& a, const Aabb& b) {
    return {
        {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
        {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

}  // namespace

double squared_distance(const Aabb& a, const Aabb& b) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double gap =
            std::max({0.0, at(a.low, k) - at(b.high, k), at(b.low, k) - at(a.high, k)});
        sum += gap * gap;
    }
    return sum;
}

Ray make_ray(Vec3 origin, Vec3 direction) {
    return {origin, direction, {1 / direction.x, 1 / direction.y, 1 / direction.z}};
}

double entry(const Ray& ray, const Aabb& box) {
    double from = 0, to = kInfinity;
    for (int k = 0; k < 3; ++k) {
        const double o = at(ray.origin, k), inverse = at(ray.one_over, k);
        if (std::isinf(inverse)) {
            if (o < at(box.low, k) || o > at(box.high, k)) return kInfinity;
            continue;
        }
        const double s = (at(box.low, k) - o) * inverse, t = (at(box.high, k) - o) * inverse;
        from = std::max(from, std::min(s, t));
        to = std::min(to, std::max(s, t));
    }
    // Rounding must not lose a box that is flat, or that is met at a corner.
    return from <= to + 1e-12 * (1 + from) ? std::min(from, to) : kInfinity;
}

BoxTree::BoxTree(const std::vector<Aabb>& boxes) {
    if (boxes.empty()) return;
    items_.resize(boxes.size());
    std::iota(items_.begin(), items_.end(), 0u);
    for (const Aabb& box : boxes) middles_.push_back(0.5 * (box.low + box.high));
    boxes_ = boxes;
    nodes_.reserve(boxes.size());
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(boxes.size()));

    // The boxes follow their items.
    for (std::size_t i = 0; i < items_.size(); ++i) boxes_[i] = boxes[items_[i]];
    middles_.clear();
    middles_.shrink_to_fit();
}

void BoxTree::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    Aabb box = boxes_[items_[begin]], middles{middles_[items_[begin]], middles_[items_[begin]]};
    for (std::uint32_t i = begin + 1; i < end; ++i) {
        box = joined(box, boxes_[items_[i]]);
        middles = joined(middles, {middles_[items_[i]], middles_[items_[i]]});
    }
    nodes_[node] = {box, begin, end - begin};
    if (end - begin <= kLeaf) return;

    // Halve the items along the axis on which their middles lie farthest apart.
    const Vec3 extent = middles.high - middles.low;
    const int k = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t half = begin + (end - begin) / 2;
    const auto item = [this](std::uint32_t i) { return items_.begin() + i; };
    std::nth_element(item(begin), item(half), item(end), [&](std::uint32_t p, std::uint32_t q) {
        const double s = at(middles_[p], k), t = at(middles_[q], k);
        return s < t || (s == t && p < q);
    });
    const auto left = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = left;
    nodes_[node].count = 0;
    build(left, begin, half);
    build(left + 1, half, end);
}

}  // namespace plumb
