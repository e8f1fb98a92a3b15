// SPDX-License-Identifier: MIT
/// Tubes, and the lids that close them: rings of points, each with fewer than the one around it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "reader/deformables/deformable_shapes.h"

namespace plumb::reader {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Points evenly around y, the first on +x.
struct Ring {
    std::uint32_t first = 0, count = 0;

    std::uint32_t at(std::uint32_t i) const { return first + i % count; }
};

Ring add_ring(Elements& to, double radius, double height, std::uint32_t count) {
    const Ring ring{static_cast<std::uint32_t>(to.points.size()), count};
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = kTurn * i / count;
        to.points.emplace_back(radius * std::cos(angle), height, -radius * std::sin(angle));
    }
    return ring;
}

/// Triangles between two rings, which run to the left of `outer` in its direction; `over` turns
/// them over.
void stitch(Elements& to, const Ring& outer, const Ring& inner, bool over) {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        to.triangles.push_back(over ? std::array{a, c, b} : std::array{a, b, c});
    };
    std::uint32_t i = 0, j = 0;
    while (i < outer.count || j < inner.count) {
        // The step whose end is less far around.
        const std::uint64_t outwards = std::uint64_t{i + 1} * inner.count,
                            inwards = std::uint64_t{j + 1} * outer.count;
        if (j == inner.count || (i < outer.count && outwards <= inwards)) {
            add(outer.at(i), outer.at(i + 1), inner.at(j));
            ++i;
        } else {
            add(outer.at(i), inner.at(j + 1), inner.at(j));
            ++j;
        }
    }
}

/// A disc within a ring, whose triangles are about as large as the ring's steps.
void add_lid(Elements& to, Ring ring, double radius, double height, bool over) {
    const auto rings = static_cast<std::uint32_t>(std::max(1.0, std::round(ring.count / kTurn)));
    const std::uint32_t around = ring.count;
    for (std::uint32_t k = rings - 1; k > 0; --k) {
        const Ring inner = add_ring(to, radius * k / rings, height,
                                    std::max<std::uint32_t>(5, around * k / rings));
        stitch(to, ring, inner, over);
        ring = inner;
    }
    const auto middle = static_cast<std::uint32_t>(to.points.size());
    to.points.emplace_back(0, height, 0);
    for (std::uint32_t i = 0; i < ring.count; ++i) {
        if (over)
            to.triangles.push_back({ring.at(i), middle, ring.at(i + 1)});
        else
            to.triangles.push_back({ring.at(i), ring.at(i + 1), middle});
    }
}

}  // namespace

Elements tube_surface(double radius, double length, std::array<std::uint32_t, 2> cells,
                      bool closed) {
    const auto [around, along] = cells;
    Elements made;
    std::vector<Ring> rings;
    for (std::uint32_t k = 0; k <= along; ++k)
        rings.push_back(
            add_ring(made, radius, length * (static_cast<double>(k) / along - 0.5), around));
    for (std::uint32_t k = 0; k < along; ++k)
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t a = rings[k].at(i), b = rings[k].at(i + 1), c = rings[k + 1].at(i),
                                d = rings[k + 1].at(i + 1);
            if ((i + k) % 2 == 0) {
                made.triangles.push_back({a, b, d});
                made.triangles.push_back({a, d, c});
            } else {
                made.triangles.push_back({a, b, c});
                made.triangles.push_back({b, d, c});
            }
        }
    if (closed) {
        add_lid(made, rings.front(), radius, -length / 2, true);
        add_lid(made, rings.back(), radius, length / 2, false);
    }
    return made;
}

}  // namespace plumb::reader
