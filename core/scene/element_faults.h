// SPDX-License-Identifier: MIT
/// What is wrong with the points and the elements of a deformable, one by one.
#pragma once

#include "scene/coincident_points.h"
#include "scene/deformable.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

/// Where a deformable, a link or an attachment is wrong, and why.
struct DeformableFault {
    std::string place;     ///< as files have it: "/thickness", "/triangles/7"; empty: as a whole
    std::string sentence;  ///< names the element that it is about
};

namespace deformable_faults {

/// An element with less than this share of the extent that its longest edge could give it is flat.
inline constexpr double kFlat = 1e-9;

/// Furthest that a point may lie from the origin along any axis [m].
inline constexpr double kFurthest = 1e9;

template <std::size_t N>
using Elements = std::vector<std::array<std::uint32_t, N>>;

/// "segment", "triangle" or "tetrahedron".
template <std::size_t N>
inline const char* const kNoun = N == 2   ? "segment"
                                 : N == 3 ? "triangle"
                                          : "tetrahedron";

/// The key of such elements: "segments", "triangles" or "tetrahedra".
template <std::size_t N>
inline const char* const kKey = N == 2   ? "segments"
                                : N == 3 ? "triangles"
                                         : "tetrahedra";

/// "point 3 at (0, 0.5, 1)".
inline std::string in_words(std::uint32_t point, const Eigen::Vector3d& at) {
    char text[128];
    std::snprintf(text, sizeof text, "point %u at (%.6g, %.6g, %.6g)", point, at.x(), at.y(),
                  at.z());
    return text;
}

/// Length, twice the area, or six times the signed volume of an element, over what its longest
/// edge from its first point could make of it.
template <std::size_t N>
double relative_extent(const std::vector<Eigen::Vector3d>& points,
                       const std::array<std::uint32_t, N>& element) {
    const auto edge = [&](std::size_t k) -> Eigen::Vector3d {
        return points[element[k]] - points[element[0]];
    };
    double longest = 0;
    for (std::size_t k = 1; k < N; ++k) longest = std::max(longest, edge(k).norm());
    if (!(longest > 0)) return 0;
    if constexpr (N == 2) return 1;
    if constexpr (N == 3) return (edge(1) / longest).cross(edge(2) / longest).norm();
    if constexpr (N == 4)
        return (edge(1) / longest).cross(edge(2) / longest).dot(edge(3) / longest);
}

inline std::optional<DeformableFault> points_fault(const std::vector<Eigen::Vector3d>& points) {
    if (points.empty()) return DeformableFault{"/points", "there are no points"};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const char* wrong = !points[i].allFinite() ? " is not finite"
                            : points[i].cwiseAbs().maxCoeff() > kFurthest
                                ? " lies further from the origin than 1e9 m"
                                : nullptr;
        if (!wrong) continue;
        const std::string number = std::to_string(i);
        return DeformableFault{"/points/" + number, ("point " + number).append(wrong)};
    }
    return std::nullopt;
}

template <std::size_t N>
DeformableFault fault_of_element(std::size_t i, const std::string& what) {
    const std::string number = std::to_string(i);
    return {std::string("/") + kKey<N> + "/" + number,
            std::string(kNoun<N>) + " " + number + " " + what};
}

template <std::size_t N>
std::optional<DeformableFault> element_fault(const std::vector<Eigen::Vector3d>& points,
                                             const Elements<N>& elements) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto fault = [i](const std::string& what) { return fault_of_element<N>(i, what); };
        for (std::size_t k = 0; k < N; ++k) {
            const std::uint32_t p = elements[i][k];
            if (p >= points.size())
                return fault("has point " + std::to_string(p) + ", but there are only " +
                             std::to_string(points.size()) + " points, numbered from 0");
            if (std::find(elements[i].begin() + k + 1, elements[i].end(), p) != elements[i].end())
                return fault("has point " + std::to_string(p) + " twice");
        }
        const double extent = relative_extent(points, elements[i]);
        if (N == 2 && !(extent > kFlat)) return fault("has no length: its points fall together");
        if (N == 3 && !(extent > kFlat))
            return fault("has no area: its points fall together or lie in a line");
        if (N == 4 && !(std::abs(extent) > kFlat))
            return fault("has no volume: its points fall together or lie in a plane");
        if (N == 4 && extent < 0)
            return fault(
                "is turned inside out: seen from its fourth point, the first three must run "
                "counter-clockwise");
    }
    return std::nullopt;
}

/// A point without an element would have no mass.
template <std::size_t N>
std::optional<DeformableFault> unused_point_fault(const std::vector<Eigen::Vector3d>& points,
                                                  const Elements<N>& elements) {
    if (elements.empty())
        return DeformableFault{std::string("/") + kKey<N>,
                               std::string("there must be at least one ") + kNoun<N>};
    std::vector<bool> used(points.size(), false);
    for (const auto& element : elements)
        for (const std::uint32_t p : element) used[p] = true;
    const auto unused = std::find(used.begin(), used.end(), false);
    if (unused == used.end()) return std::nullopt;
    const auto p = static_cast<std::uint32_t>(unused - used.begin());
    return DeformableFault{"/points/" + std::to_string(p),
                           in_words(p, points[p]) + " belongs to no " + kNoun<N>};
}

/// Two points at one place are most often a seam that has come apart.
inline std::optional<DeformableFault> twin_fault(const std::vector<Eigen::Vector3d>& points) {
    const auto first = first_at_place(points, kSamePlace * size_of(points));
    for (std::uint32_t i = 0; i < first.size(); ++i)
        if (first[i] != i)
            return DeformableFault{"/points/" + std::to_string(i),
                                   in_words(i, points[i]) + " lies where point " +
                                       std::to_string(first[i]) +
                                       " does; elements that meet there must share one point"};
    return std::nullopt;
}

}  // namespace deformable_faults

}  // namespace plumb
