// SPDX-License-Identifier: MIT
/// Balls from the icosahedron: its faces as one sphere, or its 20 tetrahedra about the middle as
/// spheres inside each other.
///
/// A tetrahedron is cut by planes parallel to its faces into n³ pieces of one volume: small
/// tetrahedra either way up, and octahedra, each of which becomes four tetrahedra about a diagonal.
/// Each layer of points then moves out to its sphere. Neighbours share their faces' points, and
/// cut those faces in the same way.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "reader/deformables/deformable_shapes.h"

namespace plumb::reader {

namespace {

using Corner = std::array<std::uint32_t, 3>;  // steps along the three edges from the middle

constexpr std::array<Corner, 20> kFaces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

Eigen::Vector3d icosahedron_vertex(std::uint32_t i) {
    const double t = (1 + std::sqrt(5.0)) / 2;
    const double one = i % 2 == 0 ? -1 : 1, golden = i % 4 < 2 ? t : -t;
    if (i < 4) return {one, golden, 0};
    if (i < 8) return {0, one, golden};
    return {golden, 0, one};
}

/// Points of all faces, those that faces share once.
class Layers {
public:
    Layers(double radius, std::uint32_t cells) : radius_(radius), cells_(cells) {}

    /// The point so many steps along each edge of a face; their sum is the layer.
    std::uint32_t point(const Corner& face, const Corner& steps) {
        // Which vertices a point lies between, and how far from each, whatever face asks.
        Weights weights{};
        std::uint32_t layer = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (steps[k] > 0) weights[k] = {face[k], steps[k]};
            layer += steps[k];
        }
        std::sort(weights.begin(), weights.end());
        const auto next = static_cast<std::uint32_t>(made_.points.size());
        const auto [place, is_new] = numbers_.emplace(weights, next);
        if (is_new) {
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (const auto& [vertex, weight] : weights) sum += weight * icosahedron_vertex(vertex);
            if (layer > 0) sum *= radius_ * layer / cells_ / sum.norm();
            made_.points.push_back(sum);
        }
        return place->second;
    }

    void add_triangle(const std::array<std::uint32_t, 3>& t) { made_.triangles.push_back(t); }

    void add_tetrahedron(std::array<std::uint32_t, 4> t) {
        const auto& p = made_.points;
        const Eigen::Vector3d o = p[t[0]];
        if ((p[t[1]] - o).cross(p[t[2]] - o).dot(p[t[3]] - o) < 0) std::swap(t[0], t[1]);
        made_.tetrahedra.push_back(t);
    }

    double apart(std::uint32_t i, std::uint32_t j) const {
        return (made_.points[i] - made_.points[j]).norm();
    }

    Elements take() { return std::move(made_); }

private:
    /// Vertex and weight; the weights of those that do not matter are 0.
    using Weights = std::array<std::pair<std::uint32_t, std::uint32_t>, 3>;

    double radius_;
    std::uint32_t cells_;
    std::map<Weights, std::uint32_t> numbers_;
    Elements made_;
};

/// Calls `look` with all steps along three edges that sum up to `sum`.
template <class Look>
void for_each_of_layer(std::uint32_t sum, Look look) {
    for (std::uint32_t i = 0; i <= sum; ++i)
        for (std::uint32_t j = 0; i + j <= sum; ++j) look(Corner{i, j, sum - i - j});
}

Corner moved(const Corner& c, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return {c[0] + i, c[1] + j, c[2] + k};
}

/// Opposite corners stand at opposite places of the list: 0 and 5, 1 and 4, 2 and 3.
void add_octahedron(Layers& layers, const std::array<std::uint32_t, 6>& corners) {
    std::size_t shortest = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (layers.apart(corners[k], corners[5 - k]) <
            (1 - 1e-9) * layers.apart(corners[shortest], corners[5 - shortest]))
            shortest = k;
    const std::size_t one = (shortest + 1) % 3, other = (shortest + 2) % 3;
    const std::array<std::uint32_t, 4> ring{corners[one], corners[other], corners[5 - one],
                                            corners[5 - other]};
    for (std::size_t k = 0; k < 4; ++k)
        layers.add_tetrahedron(
            {corners[shortest], corners[5 - shortest], ring[k], ring[(k + 1) % 4]});
}

void fill(Layers& layers, const Corner& face, std::uint32_t cells) {
    const auto at = [&](const Corner& c, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        return layers.point(face, moved(c, i, j, k));
    };
    for (std::uint32_t layer = 1; layer <= cells; ++layer) {
        for_each_of_layer(layer - 1, [&](const Corner& c) {
            layers.add_tetrahedron(
                {at(c, 0, 0, 0), at(c, 1, 0, 0), at(c, 0, 1, 0), at(c, 0, 0, 1)});
        });
        if (layer < 2) continue;
        for_each_of_layer(layer - 2, [&](const Corner& c) {
            add_octahedron(layers, {at(c, 1, 0, 0), at(c, 0, 1, 0), at(c, 0, 0, 1), at(c, 1, 1, 0),
                                    at(c, 1, 0, 1), at(c, 0, 1, 1)});
        });
        if (layer < 3) continue;
        for_each_of_layer(layer - 3, [&](const Corner& c) {
            layers.add_tetrahedron(
                {at(c, 1, 1, 1), at(c, 1, 1, 0), at(c, 1, 0, 1), at(c, 0, 1, 1)});
        });
    }
}

}  // namespace

std::uint64_t ball_surface_points(std::uint64_t cells) { return 10 * cells * cells + 2; }

std::uint64_t ball_solid_points(std::uint64_t cells) {
    return 1 + 2 * cells + 5 * cells * (cells + 1) * (2 * cells + 1) / 3;
}

Elements ball_surface(double radius, std::uint32_t cells) {
    Layers layers(radius, cells);
    for (const Corner& face : kFaces) {
        const auto at = [&](const Corner& c, std::uint32_t i, std::uint32_t j, std::uint32_t k) {
            return layers.point(face, moved(c, i, j, k));
        };
        for_each_of_layer(cells - 1, [&](const Corner& c) {
            layers.add_triangle({at(c, 1, 0, 0), at(c, 0, 1, 0), at(c, 0, 0, 1)});
        });
        if (cells < 2) continue;
        for_each_of_layer(cells - 2, [&](const Corner& c) {
            layers.add_triangle({at(c, 1, 1, 0), at(c, 0, 1, 1), at(c, 1, 0, 1)});
        });
    }
    return layers.take();
}

Elements ball_solid(double radius, std::uint32_t cells) {
    Layers layers(radius, cells);
    for (const Corner& face : kFaces) fill(layers, face, cells);
    Elements made = layers.take();
    made.triangles = surface_of(made.tetrahedra);
    return made;
}

}  // namespace plumb::reader
