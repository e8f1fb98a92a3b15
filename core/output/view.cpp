// SPDX-License-Identifier: MIT
#include "output/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb {
namespace {

double farthest(const std::vector<Eigen::Vector3d>& vertices) {
    double square = 0;
    for (const Eigen::Vector3d& v : vertices) square = std::max(square, v.squaredNorm());
    return std::sqrt(square);
}

double height_field_radius(const Geometry& g) {
    double height = 0;
    for (const double h : g.heights) height = std::max(height, std::abs(h));
    const double x = 0.5 * g.spacing_x * std::max(0.0, g.columns - 1.0);
    const double z = 0.5 * g.spacing_z * std::max(0.0, g.rows - 1.0);
    return Eigen::Vector3d(x, height, z).norm();
}

double compound_radius(const Geometry& g) {
    double radius = 0;
    for (const GeometryPart& part : g.parts) {
        radius = std::max(radius, part.local.position.norm() + bounding_radius(part.geometry));
    }
    return radius;
}

/// Middle value; reorders its argument.
double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Eigen::Vector3d median_centre(const std::vector<Ball>& balls) {
    Eigen::Vector3d centre;
    std::vector<double> values(balls.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(balls.begin(), balls.end(), values.begin(),
                       [axis](const Ball& ball) { return ball.centre[axis]; });
        centre[axis] = median(values);
    }
    return centre;
}

/// Leaves out what lies many times farther from the middle than most.
void drop_outliers(std::vector<Ball>& balls) {
    const Eigen::Vector3d centre = median_centre(balls);
    std::vector<double> distances;
    for (const Ball& ball : balls) distances.push_back((ball.centre - centre).norm() + ball.radius);
    const double limit = 5 * median(distances);
    std::erase_if(balls, [&](const Ball& ball) {
        return (ball.centre - centre).norm() + ball.radius > limit;
    });
}

/// Distance from `target` along `back` at which every ball lies within the pyramid of the picture.
double fitting_distance(const std::vector<Ball>& balls, const Eigen::Vector3d& target,
                        const Eigen::Matrix3d& axes, double half_angle, double aspect) {
    const double tan_y = std::tan(half_angle), tan_x = tan_y * aspect;
    double distance = 0;
    for (const Ball& ball : balls) {
        const Eigen::Vector3d p = axes.transpose() * (ball.centre - target);
        const double for_x = (std::abs(p.x()) + ball.radius * std::hypot(1.0, tan_x)) / tan_x;
        const double for_y = (std::abs(p.y()) + ball.radius * std::hypot(1.0, tan_y)) / tan_y;
        distance = std::max(distance, p.z() + std::max(for_x, for_y));
    }
    return distance;
}

/// Adds those of a deformable's particles that are outermost in some direction, without the few
/// that flew far away.
void add_outermost(std::vector<Ball>& balls, const RecordedDeformable& deformable,
                   const Frame& frame) {
    std::vector<Ball> all;
    const double radius = std::max(deformable.radius, 1e-6);
    for (std::size_t i = deformable.first; i < deformable.first + deformable.count; ++i)
        if (frame.particles[i].allFinite()) all.push_back({frame.particles[i], radius});
    if (all.empty()) return;
    drop_outliers(all);
    for (int i = 0; i < 27; ++i) {
        const Eigen::Vector3d way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (way.isZero()) continue;
        balls.push_back(
            *std::max_element(all.begin(), all.end(), [&way](const Ball& a, const Ball& b) {
                return way.dot(a.centre) < way.dot(b.centre);
            }));
    }
}

}  // namespace

double bounding_radius(const Geometry& g) {
    switch (g.kind) {
        case ShapeKind::plane:
            return 0;
        case ShapeKind::sphere:
            return g.radius;
        case ShapeKind::box:
            return g.half_extents.norm();
        case ShapeKind::capsule:
            return g.radius + g.half_height;
        case ShapeKind::cylinder:
        case ShapeKind::cone:
            return std::hypot(g.radius, g.half_height);
        case ShapeKind::hull:
        case ShapeKind::mesh:
            return farthest(g.vertices);
        case ShapeKind::height_field:
            return height_field_radius(g);
        case ShapeKind::compound:
            return compound_radius(g);
    }
    return 0;
}

Eigen::Vector3d up_direction(const RecordingHeader& header) {
    const double strength = header.gravity.norm();
    if (!(strength > 0) || !std::isfinite(strength)) return Eigen::Vector3d::UnitY();
    return -header.gravity / strength;
}

std::vector<Ball> balls_of_interest(const RecordingHeader& header, const Frame& frame) {
    std::vector<Ball> movable, fixed;
    const std::size_t count = std::min(header.bodies.size(), frame.bodies.size());
    for (std::size_t i = 0; i < count; ++i) {
        const RecordedBody& body = header.bodies[i];
        const Eigen::Vector3d& position = frame.bodies[i].placement.position;
        if (body.geometry >= header.geometries.size() || !position.allFinite()) continue;
        const double radius = bounding_radius(header.geometries[body.geometry]);
        if (!(radius > 0)) continue;
        (body.motion == Motion::fixed ? fixed : movable).push_back({position, radius});
    }
    if (frame.particles.size() == particle_count(header.deformables))
        for (const RecordedDeformable& deformable : header.deformables)
            add_outermost(movable, deformable, frame);
    return movable.empty() ? fixed : movable;
}

View chosen_view(const RecordingHeader& header, std::vector<Ball> balls, double aspect) {
    if (header.view) {
        const double distance = (header.view->eye - header.view->target).norm();
        const double angle = header.view->field_of_view;
        if (std::isfinite(distance) && distance > 0 && angle >= 1 && angle <= 170) {
            return *header.view;
        }
    }
    return fitted_view(std::move(balls), up_direction(header), aspect);
}

View fitted_view(std::vector<Ball> balls, const Eigen::Vector3d& up, double aspect) {
    if (balls.empty()) return View{};
    drop_outliers(balls);

    // Looks down from the front and the right; `axes` are right, up and back of the picture.
    const Eigen::Vector3d across =
        std::abs(up.x()) < 0.7 ? -Eigen::Vector3d::UnitX().eval() : Eigen::Vector3d::UnitY().eval();
    const Eigen::Vector3d front = up.cross(across).normalized();
    const Eigen::Vector3d right = up.cross(front).normalized();
    const Eigen::Vector3d back = (0.85 * front + 0.55 * right + 0.38 * up).normalized();
    Eigen::Matrix3d axes;
    axes.col(2) = back;
    axes.col(0) = up.cross(back).normalized();
    axes.col(1) = back.cross(axes.col(0));

    Eigen::AlignedBox3d box;
    for (const Ball& ball : balls) {
        box.extend((ball.centre.array() - ball.radius).matrix());
        box.extend((ball.centre.array() + ball.radius).matrix());
    }
    View view;
    view.target = box.center();
    view.field_of_view = 35;
    const double half_angle = 0.5 * view.field_of_view * std::numbers::pi / 180;
    view.eye =
        view.target + 1.12 * fitting_distance(balls, view.target, axes, half_angle, aspect) * back;
    return view;
}

}  // namespace plumb
