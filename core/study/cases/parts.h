// SPDX-License-Identifier: MIT
/// What the scenes of the cases are put together from.
#pragma once

#include "math/rotation_between.h"
#include "scene/build.h"
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

/// Instead, steps of 10 ms with five iterations of each pass: for what has hundreds of bodies.
inline void use_coarse_steps(Subject& s) {
    s.scene.settings.dt = 0.01;
    s.scene.settings.substeps = 1;
    s.scene.settings.velocity_iterations = s.scene.settings.position_iterations = 5;
}

/// Turn about z by which ground climbs along x [rad].
inline Eigen::Quaterniond slope_of(double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

/// Adds a plane through the origin that climbs along x by `angle` [rad].
inline void add_slope(Scene& scene, double angle) {
    plumb::add_ground(scene).placement.rotation = slope_of(angle);
}

/// Turn that takes x, a joint's axis, to a unit vector.
inline Eigen::Quaterniond axis_along(const Eigen::Vector3d& axis) {
    return rotation_between(Eigen::Vector3d::UnitX(), axis);
}

}  // namespace plumb::study
