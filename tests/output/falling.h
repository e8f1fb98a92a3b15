// SPDX-License-Identifier: MIT
/// A made-up run for the tests of the outputs: bodies of all kinds fall, turn, bounce and come to
/// rest on a plane.
#pragma once

#include "measure/frame.h"
#include "scene/build.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace plumb::test {

/// An octahedron.
inline Geometry hull(double r) {
    Geometry g;
    g.kind = ShapeKind::hull;
    g.vertices = {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
    g.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
               {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return g;
}

/// A tetrahedron, as triangles.
inline Geometry mesh(double r) {
    Geometry g;
    g.kind = ShapeKind::mesh;
    g.vertices = {{r, r, r}, {-r, -r, r}, {-r, r, -r}, {r, -r, -r}};
    g.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return g;
}

inline Geometry compound(double r) {
    Geometry g;
    g.kind = ShapeKind::compound;
    Placement left, right;
    left.position = {-2 * r, 0, 0};
    right.position = {2 * r, 0, 0};
    Placement bar;
    bar.rotation = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ());
    g.parts = {{sphere(r), left}, {sphere(r), right}, {cylinder(r / 3, 2 * r), bar}};
    return g;
}

inline Geometry hills(std::uint32_t size, double spacing) {
    Geometry g;
    g.kind = ShapeKind::height_field;
    g.rows = g.columns = size;
    g.spacing_x = g.spacing_z = spacing;
    for (std::uint32_t i = 0; i < size * size; ++i) {
        g.heights.push_back(0.25 * std::sin(0.9 * (i % size)) * std::cos(0.7 * (i / size)) - 0.1);
    }
    return g;
}

/// `count` bodies above a plane; each shape kind occurs among the first nine.
inline Scene falling_scene(int count) {
    Scene scene;
    scene.name = "Falling bodies";
    scene.description = "Spheres, boxes and others on their way to the ground";
    scene.geometries = {plane(),
                        sphere(0.3),
                        box(0.3, 0.3, 0.3),
                        box(0.45, 0.15, 0.25),
                        capsule(0.18, 0.25),
                        cylinder(0.25, 0.3),
                        cone(0.3, 0.35),
                        hull(0.36),
                        mesh(0.24),
                        compound(0.2),
                        hills(12, 0.5)};
    BodySpec ground;
    ground.name = "ground";
    ground.motion = Motion::fixed;
    ground.geometry = 0;
    BodySpec field;
    field.name = "hills";
    field.motion = Motion::fixed;
    field.geometry = 10;
    field.placement.position = {-7.5, 0.2, 0};
    scene.bodies = {ground, field};
    for (int i = 0; i < count; ++i) {
        BodySpec body;
        body.name = "body " + std::to_string(i);
        body.geometry =
            i < 9 ? 1 + static_cast<std::uint32_t>(i) : 1 + static_cast<std::uint32_t>(i % 3);
        scene.bodies.push_back(body);
    }
    return scene;
}

/// Height of a body that was dropped and bounces until it rests at `floor` [m].
inline double bouncing_height(double start, double floor, double time) {
    double speed = 0, height = start;
    for (int bounce = 0; bounce < 6; ++bounce) {
        const double fall = (speed + std::sqrt(speed * speed + 2 * 9.81 * (height - floor))) / 9.81;
        if (time < fall) return height + speed * time - 0.5 * 9.81 * time * time;
        time -= fall;
        speed = 0.4 * std::abs(speed - 9.81 * fall);
        height = floor;
    }
    return floor;
}

/// The made-up run at a time [s].
inline Frame falling_frame(const Scene& scene, std::uint64_t step, double time) {
    Frame frame;
    frame.step = step;
    frame.time = time;
    frame.bodies.resize(scene.bodies.size());
    const int side =
        static_cast<int>(std::ceil(std::cbrt(static_cast<double>(scene.bodies.size()))));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        BodyState& state = frame.bodies[i];
        state.placement = scene.bodies[i].placement;
        state.velocity.setZero();
        state.angular_velocity.setZero();
        if (scene.bodies[i].motion == Motion::fixed) continue;
        const int k = static_cast<int>(i) - 2, layer = k / (side * side);
        const double floor = 0.3 + 0.6 * layer,
                     start = floor + 1 + 0.4 * layer + 0.3 * std::sin(3.7 * k);
        const double turn = std::min(time, 1.5);
        state.placement.position = {
            0.72 * (k % side - 0.5 * side) + 0.05 * std::sin(1.3 * k) * turn,
            bouncing_height(start, floor, time), 0.72 * (k / side % side - 0.5 * side)};
        const Eigen::Vector3d axis(std::sin(1.0 * k), std::cos(2.1 * k), 0.5);
        state.placement.rotation = Eigen::AngleAxisd(0.3 * turn * (1 + k % 3), axis.normalized());
        state.velocity = {0.1 * k, -9.81 * time, 1.0 / 3};
        state.angular_velocity = axis * 0.7;
    }
    frame.contacts =
        static_cast<std::uint32_t>(4 * time * static_cast<double>(scene.bodies.size()));
    frame.kinetic_energy = 1234.5 * std::exp(-time);
    frame.potential_energy = 9876.5 - 100 * time;
    frame.deepest_penetration = 0.0012 * time;
    frame.residual.force_of_weight = 0.3 * std::exp(-3 * time);
    frame.residual.force = 700 * frame.residual.force_of_weight;
    frame.residual.error = 1e-3 * frame.residual.force_of_weight;
    return frame;
}

}  // namespace plumb::test
