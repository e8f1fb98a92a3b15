// SPDX-License-Identifier: MIT
#include "solve/patch_tree.h"

#include <algorithm>
#include <numeric>

namespace plumb {

PatchTree::PatchTree(const std::vector<Element>& elements, const std::vector<std::uint32_t>& ends,
                     std::uint32_t least)
    : order_(elements.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::uint32_t first = 0;
    for (const std::uint32_t last : ends) {
        if (last - first >= least) split(elements, first, last, least, kNoIndex);
        first = last;
    }
    find_points(elements);
}

/// Halves across the longest extent of the elements' middles.
std::uint32_t PatchTree::split(const std::vector<Element>& elements, std::uint32_t first,
                               std::uint32_t last, std::uint32_t least, std::uint32_t parent) {
    const auto self = static_cast<std::uint32_t>(patches_.size());
    patches_.push_back({first, last, 0, 0, parent, {kNoIndex, kNoIndex}});
    if (last - first < 2 * least) return self;
    Vector3d low = elements[order_[first]].middle, high = low;
    for (std::uint32_t i = first; i < last; ++i) {
        low = low.cwiseMin(elements[order_[i]].middle);
        high = high.cwiseMax(elements[order_[i]].middle);
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    std::stable_sort(order_.begin() + first, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                         return elements[a].middle[axis] < elements[b].middle[axis];
                     });
    const std::uint32_t middle = first + (last - first) / 2;
    const std::uint32_t lower = split(elements, first, middle, least, self),
                        upper = split(elements, middle, last, least, self);
    patches_[self].half[0] = lower, patches_[self].half[1] = upper;
    return self;
}

void PatchTree::find_points(const std::vector<Element>& elements) {
    std::vector<std::vector<std::uint32_t>> corners_of;  // [point of the patch at hand]
    std::vector<std::uint32_t> place;                    // [particle], or kNoIndex
    for (const Element& e : elements)
        for (const std::uint32_t p : e.particles)
            if (p >= place.size()) place.resize(p + 1, kNoIndex);
    for (std::size_t at = patches_.size(); at-- > 0;) {
        Patch& patch = patches_[at];
        patch.point = static_cast<std::uint32_t>(points_.size());
        const auto find = [&](std::uint32_t particle) -> std::uint32_t {
            if (place[particle] == kNoIndex) {
                place[particle] = static_cast<std::uint32_t>(points_.size());
                points_.push_back({particle, {kNoIndex, kNoIndex}});
            }
            return place[particle];
        };
        if (patch.is_smallest()) {
            corners_of.clear();
            for (std::uint32_t i = patch.first; i < patch.last; ++i) {
                const auto& particles = elements[order_[i]].particles;
                for (std::size_t k = 0; k < particles.size(); ++k) {
                    const std::uint32_t local = find(particles[k]) - patch.point;
                    if (local == corners_of.size()) corners_of.emplace_back();
                    corners_of[local].push_back(
                        static_cast<std::uint32_t>(i * particles.size() + k));
                }
            }
            for (std::size_t k = 0; k < corners_of.size(); ++k) {
                PatchPoint& point = points_[patch.point + k];
                point.from[0] = static_cast<std::uint32_t>(corners_.size());
                corners_.insert(corners_.end(), corners_of[k].begin(), corners_of[k].end());
                point.from[1] = static_cast<std::uint32_t>(corners_.size());
            }
        } else {
            for (int half = 0; half < 2; ++half) {
                const Patch& part = patches_[patch.half[half]];
                for (std::uint32_t i = part.point; i < part.point_end; ++i)
                    points_[find(points_[i].particle)].from[half] = i;
            }
        }
        patch.point_end = static_cast<std::uint32_t>(points_.size());
        for (std::uint32_t i = patch.point; i < patch.point_end; ++i)
            place[points_[i].particle] = kNoIndex;
    }
}

}  // namespace plumb
