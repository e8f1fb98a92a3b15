// SPDX-License-Identifier: MIT
/// What is wrong with a deformable by its own numbers, in a sentence that names the element.
/// Whoever takes deformables asks here, files and programs alike.
#pragma once

#include "scene/deformable.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace plumb {

/// Where a deformable is wrong, and why.
struct DeformableFault {
    std::string place;  ///< "/triangles/7", "/thickness"; empty: the deformable as a whole
    std::string sentence;
};

namespace deformable_faults {

/// An element with less than this share of the extent that its longest edge could give it is flat.
inline constexpr double kFlat = 1e-9;

template <std::size_t N>
inline std::optional<DeformableFault> element_fault(
    const std::vector<Eigen::Vector3d>& points,
    const std::vector<std::array<std::uint32_t, N>>& elements, const std::string& key) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const std::string place = "/" + key + "/" + std::to_string(i);
        for (const std::uint32_t p : elements[i])
            if (p >= points.size())
                return DeformableFault{place, "has point " + std::to_string(p) +
                                                  ", and there are only " +
                                                  std::to_string(points.size())};
        double longest = 0;
        for (std::size_t k = 1; k < N; ++k)
            longest = std::max(longest, (points[elements[i][k]] - points[elements[i][0]]).norm());
        double extent = longest, full = 0;
        const auto edge = [&](std::size_t k) -> Eigen::Vector3d {
            return points[elements[i][k]] - points[elements[i][0]];
        };
        if constexpr (N == 3) extent = edge(1).cross(edge(2)).norm(), full = longest * longest;
        if constexpr (N == 4)
            extent = edge(1).cross(edge(2)).dot(edge(3)), full = longest * longest * longest;
        if (!(longest > 0) || !(std::abs(extent) > kFlat * full))
            return DeformableFault{place, "has no extent: its points fall together or in a line"};
        if (extent < 0) return DeformableFault{place, "is turned inside out"};
    }
    return std::nullopt;
}

}  // namespace deformable_faults

/// The first fault of a deformable in a scene of so many materials.
inline std::optional<DeformableFault> deformable_fault(const DeformableSpec& spec,
                                                       std::size_t material_count) {
    if (spec.points.empty()) return DeformableFault{"/points", "there are none"};
    for (std::size_t i = 0; i < spec.points.size(); ++i)
        if (!spec.points[i].allFinite())
            return DeformableFault{"/points/" + std::to_string(i), "is not finite"};
    if (spec.material >= material_count)
        return DeformableFault{"/material", "there is no such material"};
    if (auto fault = deformable_faults::element_fault(spec.points, spec.segments, "segments"))
        return fault;
    if (auto fault = deformable_faults::element_fault(spec.points, spec.triangles, "triangles"))
        return fault;
    return deformable_faults::element_fault(spec.points, spec.tetrahedra, "tetrahedra");
}

}  // namespace plumb
