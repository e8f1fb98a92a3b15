// SPDX-License-Identifier: MIT
/// A made-up run of deformables of all kinds: each point goes its way by a formula.
#pragma once

#include "measure/frame.h"
#include "scene/build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace plumb::test {

/// A square sheet of n × n points in the plane y = 0.
inline DeformableSpec sheet(std::uint32_t n, double side) {
    DeformableSpec spec;
    spec.name = "sheet";
    for (std::uint32_t i = 0; i < n * n; ++i)
        spec.points.push_back(
            {side * (i % n) / (n - 1) - side / 2, 0, side * (i / n) / (n - 1) - side / 2});
    for (std::uint32_t row = 0; row + 1 < n; ++row) {
        for (std::uint32_t column = 0; column + 1 < n; ++column) {
            const std::uint32_t a = row * n + column, b = a + n;
            spec.triangles.push_back({a, b, a + 1});
            spec.triangles.push_back({a + 1, b, b + 1});
        }
    }
    return spec;
}

/// An octahedron whose triangles are divided in four so many times, and blown up to a ball.
inline DeformableSpec balloon(int divisions, double radius) {
    DeformableSpec spec;
    spec.name = "balloon";
    spec.kind = DeformableKind::balloon;
    auto& p = spec.points;
    p = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    spec.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                      {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int i = 0; i < divisions; ++i) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, made] =
                known.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.size()));
            if (made) p.push_back(Eigen::Vector3d(p[a] + p[b]).normalized());
            return at->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : spec.triangles) {
            const std::uint32_t d = middle(a, b), e = middle(b, c), f = middle(c, a);
            finer.insert(finer.end(), {{a, d, f}, {d, b, e}, {f, e, c}, {d, e, f}});
        }
        spec.triangles = finer;
    }
    for (Eigen::Vector3d& point : p) point *= radius;
    return spec;
}

/// A cube of n³ cells, each of six tetrahedra about its diagonal; no triangles are given.
inline DeformableSpec jelly(std::uint32_t n, double side) {
    DeformableSpec spec;
    spec.name = "jelly";
    spec.kind = DeformableKind::solid;
    const std::uint32_t m = n + 1;
    for (std::uint32_t i = 0; i < m * m * m; ++i)
        spec.points.push_back(side / n * Eigen::Vector3d(i % m, i / m % m, i / (m * m)));
    constexpr std::array<std::array<int, 3>, 6> kWays{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    const std::array<std::uint32_t, 3> step{1, m, m * m};
    for (std::uint32_t cell = 0; cell < n * n * n; ++cell) {
        const std::uint32_t a = cell % n + m * (cell / n % n) + m * m * (cell / (n * n));
        for (std::size_t way = 0; way < kWays.size(); ++way) {
            const auto along = [&](std::size_t k) {
                return step[static_cast<std::size_t>(kWays[way][k])];
            };
            const std::uint32_t b = a + along(0), c = b + along(1), d = c + along(2);
            // three of the ways are turns of x, y, z, the others are mirrored
            spec.tetrahedra.push_back(way < 3 ? std::array{a, b, c, d} : std::array{a, c, b, d});
        }
    }
    return spec;
}

inline DeformableSpec rope(std::uint32_t pieces, double length, double diameter) {
    DeformableSpec spec;
    spec.name = "rope, long";
    spec.kind = DeformableKind::rope;
    spec.thickness = diameter;
    for (std::uint32_t i = 0; i <= pieces; ++i) {
        spec.points.push_back({length * i / pieces - length / 2, 0, 0});
        if (i > 0) spec.segments.push_back({i - 1, i});
    }
    return spec;
}

inline void move_to(DeformableSpec& spec, const Eigen::Vector3d& place) {
    for (Eigen::Vector3d& point : spec.points) point += place;
}

/// One of each kind, and a ball that is linked to two of them.
inline Scene soft_scene(std::uint32_t fineness) {
    Scene scene;
    scene.name = "Soft";
    scene.geometries = {sphere(0.2)};
    BodySpec ball;
    ball.geometry = 0;
    ball.placement.position = {3, 1, 0};
    ball.placement.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
    scene.bodies = {ball};
    scene.deformables = {sheet(4 * fineness + 1, 2), balloon(static_cast<int>(fineness), 0.5),
                         jelly(fineness, 0.6), rope(10 * fineness, 1.5, 0.03)};
    for (std::size_t i = 0; i < scene.deformables.size(); ++i)
        move_to(scene.deformables[i],
                {0, 1.0 + 0.2 * static_cast<double>(i), 2.0 * static_cast<double>(i)});
    LinkSpec link;
    link.a.body = 0, link.a.position = {3, 1.2, 0};
    link.b.deformable = 1, link.b.point = 2;
    LinkSpec world = link;
    world.a.body = kNoIndex;
    scene.links = {link, world};
    return scene;
}

/// The made-up run at a time [s]: waves run through everything.
inline Frame soft_frame(const Scene& scene, std::uint64_t step, double time) {
    Frame frame;
    frame.step = step;
    frame.time = time;
    for (const BodySpec& body : scene.bodies) {
        BodyState state{body.placement, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
        state.placement.position.y() += 0.1 * std::sin(time);
        frame.bodies.push_back(state);
    }
    for (const DeformableSpec& spec : scene.deformables)
        for (const Eigen::Vector3d& p : spec.points)
            frame.particles.push_back(
                p + 0.1 * std::sin(3 * time) *
                        Eigen::Vector3d(std::sin(p.y()),
                                        std::sin(3 * p.x() - 5 * time) + 0.3 * std::sin(7 * p.z()),
                                        std::cos(2 * p.x())));
    return frame;
}

}  // namespace plumb::test
