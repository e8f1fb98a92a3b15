// SPDX-License-Identifier: MIT
/// What the scenes of the cases are put together from.
#pragma once

#include "scene/scene.h"

#include <utility>

namespace plumb::study {

inline Geometry box(const Eigen::Vector3d& half_extents) {
    Geometry g;
    g.kind = ShapeKind::box;
    g.half_extents = half_extents;
    return g;
}

inline Geometry sphere(double radius) {
    Geometry g;
    g.kind = ShapeKind::sphere;
    g.radius = radius;
    return g;
}

/// Adds a body with a geometry of its own, and returns it, to be changed.
inline BodySpec& add_body(Scene& scene, Geometry geometry, const Eigen::Vector3d& position,
                          Motion motion = Motion::dynamic) {
    BodySpec body;
    body.motion = motion;
    body.geometry = static_cast<std::uint32_t>(scene.geometries.size());
    body.placement.position = position;
    scene.geometries.push_back(std::move(geometry));
    scene.bodies.push_back(body);
    return scene.bodies.back();
}

/// Links body a to body b, or to the world, at a point, and returns the joint, to be changed.
inline JointSpec& add_joint(Scene& scene, JointKind kind, std::uint32_t a, std::uint32_t b,
                            const Eigen::Vector3d& anchor) {
    JointSpec joint;
    joint.kind = kind;
    joint.body_a = a;
    joint.body_b = b;
    joint.anchor = anchor;
    scene.joints.push_back(joint);
    return scene.joints.back();
}

}  // namespace plumb::study
