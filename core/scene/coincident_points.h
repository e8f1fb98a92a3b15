// SPDX-License-Identifier: MIT
/// Points that lie at one place. For readers, and for faults of all layers, so all of it is here.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace plumb {

/// Two points nearer to each other than this share of the size of them all lie at one place.
inline constexpr double kSamePlace = 1e-9;

/// Diagonal of the box around points [m].
inline double size_of(const std::vector<Eigen::Vector3d>& points) {
    if (points.empty()) return 0;
    Eigen::Vector3d low = points.front(), high = low;
    for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    return (high - low).norm();
}

/// [point] the least index of a point at its place, which is its own where it has the place to
/// itself. `tolerance` in [m].
inline std::vector<std::uint32_t> first_at_place(const std::vector<Eigen::Vector3d>& points,
                                                 double tolerance) {
    // Points at one place are neighbours along any direction. Along one that no grid has, few
    // others are.
    const Eigen::Vector3d direction(0.5411961001, 0.6807837713, 0.4936173501);
    std::vector<double> along(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) along[i] = direction.dot(points[i]);
    std::vector<std::uint32_t> order(points.size()), first(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::iota(first.begin(), first.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        return along[i] != along[j] ? along[i] < along[j] : i < j;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const std::uint32_t p = order[i], q = order[j];
            if (along[q] - along[p] > tolerance) break;
            if ((points[p] - points[q]).norm() > tolerance) continue;
            first[std::max(p, q)] = std::min(first[std::max(p, q)], std::min(p, q));
        }
    }
    for (std::uint32_t& f : first) f = first[f];
    return first;
}

}  // namespace plumb
