// SPDX-License-Identifier: MIT
/// The shapes that need no more than counting: rectangles and lines.
#include "reader/deformables/deformable_shapes.h"

namespace plumb::reader {

Elements grid_surface(std::array<std::uint32_t, 2> cells, const Eigen::Vector2d& size) {
    const auto [nx, nz] = cells;
    Elements made;
    for (std::uint32_t k = 0; k <= nz; ++k)
        for (std::uint32_t i = 0; i <= nx; ++i)
            made.points.emplace_back(size.x() * (static_cast<double>(i) / nx - 0.5), 0,
                                     size.y() * (static_cast<double>(k) / nz - 0.5));
    for (std::uint32_t k = 0; k < nz; ++k)
        for (std::uint32_t i = 0; i < nx; ++i) {
            const std::uint32_t a = i + (nx + 1) * k, b = a + 1, c = a + nx + 1, d = c + 1;
            if ((i + k) % 2 == 0) {
                made.triangles.push_back({a, c, d});
                made.triangles.push_back({a, d, b});
            } else {
                made.triangles.push_back({a, c, b});
                made.triangles.push_back({b, c, d});
            }
        }
    return made;
}

Elements straight_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                       std::uint32_t segments) {
    Elements made;
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const double share = static_cast<double>(i) / segments;
        made.points.push_back((1 - share) * from + share * to);
    }
    for (std::uint32_t i = 0; i < segments; ++i) made.segments.push_back({i, i + 1});
    return made;
}

}  // namespace plumb::reader
