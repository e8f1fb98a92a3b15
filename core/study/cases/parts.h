// SPDX-License-Identifier: MIT
/// What the scenes of the cases are put together from.
#pragma once

#include "study/subject.h"

#include <cmath>
#include <string>
#include <utility>

namespace plumb::study {

inline constexpr double kGravity = 9.81;  ///< of the cases' scenes, along −y [m/s²]

/// A subject to be filled, whose empty scene has 20 substeps of one iteration each at 60 Hz.
/// `duration` [s].
inline Subject begin_subject(std::string name, std::string title, std::string reference,
                             double duration) {
    Subject s;
    s.scene.name = name;
    s.name = std::move(name), s.title = std::move(title), s.reference = std::move(reference);
    s.scene.settings.gravity = {0, -kGravity, 0};
    s.scene.settings.dt = 1.0 / 60;
    s.scene.settings.substeps = 20;
    s.scene.settings.velocity_iterations = s.scene.settings.position_iterations = 1;
    s.scene.settings.duration = duration;
    return s;
}

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

/// Turn about z by which ground climbs along x [rad].
inline Eigen::Quaterniond slope_of(double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

/// Adds a plane through the origin that climbs along x by `angle` [rad].
inline void add_ground(Scene& scene, double angle = 0) {
    Geometry plane;
    plane.kind = ShapeKind::plane;
    add_body(scene, plane, Eigen::Vector3d::Zero(), Motion::fixed).placement.rotation =
        slope_of(angle);
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

/// Turn that takes x, a joint's axis, to a unit vector.
inline Eigen::Quaterniond axis_along(const Eigen::Vector3d& axis) {
    return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), axis);
}

}  // namespace plumb::study
