// SPDX-License-Identifier: MIT
/// Scenes that a program puts together: shapes, bodies and joints in a line each.
#pragma once

#include "scene/scene.h"

#include <utility>

namespace plumb {

/// A ball of this radius [m].
inline Geometry sphere(double radius) {
    Geometry g;
    g.kind = ShapeKind::sphere;
    g.radius = radius;
    return g;
}

/// A box by half of its edges [m].
inline Geometry box(const Eigen::Vector3d& half_extents) {
    Geometry g;
    g.kind = ShapeKind::box;
    g.half_extents = half_extents;
    return g;
}
inline Geometry box(double x, double y, double z) { return box({x, y, z}); }

/// A capsule, cylinder or cone about y: radius, and half of what a plane through y shows as
/// straight [m].
inline Geometry round_about_y(ShapeKind kind, double radius, double half_height) {
    Geometry g;
    g.kind = kind;
    g.radius = radius;
    g.half_height = half_height;
    return g;
}
inline Geometry capsule(double radius, double half_height) {
    return round_about_y(ShapeKind::capsule, radius, half_height);
}
inline Geometry cylinder(double radius, double half_height) {
    return round_about_y(ShapeKind::cylinder, radius, half_height);
}
inline Geometry cone(double radius, double half_height) {
    return round_about_y(ShapeKind::cone, radius, half_height);
}

/// The half-space below y = 0.
inline Geometry plane() {
    Geometry g;
    g.kind = ShapeKind::plane;
    return g;
}

/// Adds a shape, and returns its index.
inline std::uint32_t add_geometry(Scene& scene, Geometry geometry) {
    scene.geometries.push_back(std::move(geometry));
    return static_cast<std::uint32_t>(scene.geometries.size()) - 1;
}

/// Adds a body with a shape of its own at a place [m], and returns it, to be changed until the next
/// is added; its index is the scene's last.
inline BodySpec& add_body(Scene& scene, Geometry geometry, const Eigen::Vector3d& position,
                          Motion motion = Motion::dynamic) {
    BodySpec body;
    body.motion = motion;
    body.geometry = add_geometry(scene, std::move(geometry));
    body.placement.position = position;
    scene.bodies.push_back(std::move(body));
    return scene.bodies.back();
}

/// Adds the ground: a fixed plane at y = 0.
inline BodySpec& add_ground(Scene& scene) {
    return add_body(scene, plane(), Eigen::Vector3d::Zero(), Motion::fixed);
}

/// Links body a to body b, or to the world (kNoIndex), at a point [m] of the world, and returns the
/// joint, to be changed until the next is added.
inline JointSpec& add_joint(Scene& scene, JointKind kind, std::uint32_t a, std::uint32_t b,
                            const Eigen::Vector3d& anchor) {
    JointSpec joint;
    joint.kind = kind;
    joint.body_a = a;
    joint.body_b = b;
    joint.anchor = anchor;
    scene.joints.push_back(std::move(joint));
    return scene.joints.back();
}

}  // namespace plumb
