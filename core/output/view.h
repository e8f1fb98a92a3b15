// SPDX-License-Identifier: MIT
/// Where to look from when the scene does not say.
#pragma once

#include "output/recording.h"

#include <vector>

namespace plumb {

/// Ball around a body, about the origin of its geometry's frame, or around a particle.
struct Ball {
    Eigen::Vector3d centre;
    double radius;
};

/// Distance of the farthest point of a geometry from the origin of its frame [m]; 0 for a plane,
/// which has none.
double bounding_radius(const Geometry& geometry);

/// Unit vector against gravity; +y where there is none.
Eigen::Vector3d up_direction(const RecordingHeader& header);

/// Balls of what a viewer would look for: bodies that can move and have a shape, and the outermost
/// particles of each deformable; or else the fixed bodies.
std::vector<Ball> balls_of_interest(const RecordingHeader& header, const Frame& frame);

/// The view that the scene asks for, or one that is fitted to the balls where it asks for none that
/// can be drawn.
View chosen_view(const RecordingHeader& header, std::vector<Ball> balls, double aspect);

/// A view that has the balls in the picture, but for the few that flew far away. `aspect`: width by
/// height.
View fitted_view(std::vector<Ball> balls, const Eigen::Vector3d& up, double aspect);

}  // namespace plumb
