// SPDX-License-Identifier: MIT
/// What is wrong with how the elements of a deformable meet: edges, winding, holes, volume.
#pragma once

#include "scene/element_faults.h"

#include <tuple>

namespace plumb::deformable_faults {

/// A side of an element, in the order of its points' indices, so that those of neighbours are
/// equal.
template <std::size_t N>
struct Side {
    std::array<std::uint32_t, N> points;
    std::uint32_t element;
    bool forward;  ///< of an edge: whether the triangle runs from the lower index to the higher

    bool operator<(const Side& other) const {
        return std::tie(points, element) < std::tie(other.points, other.element);
    }
};

/// The edges of triangles, those of one edge side by side.
inline std::vector<Side<2>> edges_of(const Elements<3>& triangles) {
    std::vector<Side<2>> edges;
    edges.reserve(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangles[i][k], to = triangles[i][(k + 1) % 3];
            edges.push_back({{std::min(from, to), std::max(from, to)}, i, from < to});
        }
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// Calls `look` with the first and the count of each run of sides with the same points.
template <std::size_t N, class Look>
std::optional<DeformableFault> first_fault(const std::vector<Side<N>>& sides, Look look) {
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        while (end < sides.size() && sides[end].points == sides[i].points) ++end;
        if (auto fault = look(&sides[i], end - i)) return fault;
    }
    return std::nullopt;
}

inline std::string in_words(const Side<2>& edge) {
    return "the edge from point " + std::to_string(edge.points[0]) + " to point " +
           std::to_string(edge.points[1]);
}

/// At most two triangles meet in an edge, and they run along it in opposite directions; where the
/// surface must be `closed`, they are exactly two.
inline std::optional<DeformableFault> edge_fault(const Elements<3>& triangles, bool closed) {
    return first_fault(
        edges_of(triangles),
        [&](const Side<2>* edge, std::size_t count) -> std::optional<DeformableFault> {
            const auto triangle = [&](std::size_t i) { return std::to_string(edge[i].element); };
            const auto fault = [&](std::size_t i, const std::string& sentence) {
                return DeformableFault{"/triangles/" + triangle(i), sentence};
            };
            if (count > 2)
                return fault(2, "more than two triangles meet in " + in_words(*edge) + ": " +
                                    triangle(0) + ", " + triangle(1) + " and " + triangle(2));
            if (count == 2 && edge[0].forward == edge[1].forward)
                return fault(1, "triangles " + triangle(0) + " and " + triangle(1) + " run along " +
                                    in_words(*edge) +
                                    " in the same direction: one of them is turned over");
            if (count == 1 && closed)
                return fault(0, "the surface must be closed, but " + in_words(*edge) +
                                    " belongs to triangle " + triangle(0) + " alone");
            return std::nullopt;
        });
}

/// Volume inside a closed surface, above 0 where its triangles run counter-clockwise seen from
/// outside [m³].
inline double enclosed_volume(const std::vector<Eigen::Vector3d>& points,
                              const Elements<3>& triangles) {
    double six_times = 0;
    for (const auto& t : triangles) {
        const Eigen::Vector3d &o = points.front(), a = points[t[0]] - o, b = points[t[1]] - o,
                              c = points[t[2]] - o;
        six_times += a.cross(b).dot(c);
    }
    return six_times / 6;
}

inline std::optional<DeformableFault> volume_fault(const std::vector<Eigen::Vector3d>& points,
                                                   const Elements<3>& triangles) {
    const double volume = enclosed_volume(points, triangles), size = size_of(points);
    if (!(std::abs(volume) > kFlat * size * size * size))
        return DeformableFault{"", "a balloon must enclose a volume, but its surface is flat"};
    if (volume < 0)
        return DeformableFault{"/triangles",
                               "the balloon is turned inside out: seen from outside, its triangles "
                               "must run counter-clockwise"};
    return std::nullopt;
}

/// At most two tetrahedra meet in a face.
inline std::optional<DeformableFault> face_fault(const Elements<4>& tetrahedra) {
    std::vector<Side<3>> faces;
    faces.reserve(4 * tetrahedra.size());
    for (std::uint32_t i = 0; i < tetrahedra.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& t = tetrahedra[i];
            Side<3> face{{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]}, i, true};
            std::sort(face.points.begin(), face.points.end());
            faces.push_back(face);
        }
    std::sort(faces.begin(), faces.end());
    return first_fault(
        faces, [](const Side<3>* face, std::size_t count) -> std::optional<DeformableFault> {
            if (count <= 2) return std::nullopt;
            const auto number = [&](std::size_t i) { return std::to_string(face[i].element); };
            return DeformableFault{"/tetrahedra/" + number(2),
                                   "more than two tetrahedra meet in the face of points " +
                                       std::to_string(face->points[0]) + ", " +
                                       std::to_string(face->points[1]) + " and " +
                                       std::to_string(face->points[2]) + ": " + number(0) + ", " +
                                       number(1) + " and " + number(2)};
        });
}

}  // namespace plumb::deformable_faults
