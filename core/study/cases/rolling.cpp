// SPDX-License-Identifier: MIT
/// Balls and a disk that roll.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/judges.h"
#include "study/steady_circle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::study {
namespace {

constexpr double kRadius = 0.2;  // [m]

/// A ball that slides at v₀ under friction μ rolls from t₁ = 2 v₀/7μg on, at 5/7 v₀.
struct SlidingBall {
    double speed = 5, friction = 0.5;  ///< [m/s]
    double deceleration = friction * kGravity, rolls_at = 2 * speed / (7 * deceleration);

    double velocity(double time) const { return speed - deceleration * std::min(time, rolls_at); }
    double position(double time) const {
        const double t = std::min(time, rolls_at);
        return speed * t - 0.5 * deceleration * t * t + 5 * speed / 7 * (time - t);
    }
};

}  // namespace

Subject rolling_start() {
    Subject s = begin_subject("rolling_start", "A ball that slides at first comes to roll",
                              "at t = 2 v₀/7μg, with 5 v₀/7", 2);
    const SlidingBall law;
    s.scene.materials[0].friction = law.friction;
    add_ground(s.scene);
    add_body(s.scene, sphere(kRadius), {0, kRadius, 0}).velocity = {law.speed, 0, 0};
    s.metrics = {
        largest("position", "m", "largest error of the position",
                [law](const World& w) { return w.bodies.position[1].x() - law.position(w.time); }),
        last("speed", "", "error of the speed at which it rolls", [law](const World& w) {
            return w.bodies.velocity[1].x() / law.velocity(w.time) - 1;
        })};
    s.tolerance = 1e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

Subject rolling_down() {
    Subject s = begin_subject("rolling_down", "A ball rolls down a slope of 20°",
                              "s = 5/14 g sin θ t², as long as 7 μ > 2 tan θ", 2);
    const double angle = 20 * std::numbers::pi / 180, rate = 5.0 / 7 * kGravity * std::sin(angle);
    add_slope(s.scene, angle);
    const Eigen::Quaterniond slope = slope_of(angle);
    add_body(s.scene, sphere(kRadius), slope * Vector3d(0, kRadius, 0));
    const Vector3d down = slope * -Vector3d::UnitX();
    s.metrics = {largest("way", "m", "largest error of the way", [=](const World& w) {
        return w.bodies.position[1].dot(down) - 0.5 * rate * w.time * w.time;
    })};
    s.tolerance = 3e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

Subject rolling_disk() {
    Subject s = begin_subject("rolling_disk", "A disk rolls in a circle, its axis 60° from upright",
                              "steady precession of a disk that does not slide", 3);
    const SteadyCircle circle{0.5, 0.005, std::numbers::pi / 3, 2, kGravity};
    s.scene.materials[0].friction = 1;
    add_ground(s.scene);
    const Quaterniond turn(Eigen::AngleAxisd(circle.tilt, Vector3d::UnitX()));
    const Vector3d axis = turn * Vector3d::UnitY(), up = Vector3d::UnitY();
    const Vector3d foot = turn * Vector3d(0, -circle.half_height, circle.radius);
    const Vector3d spin = circle.round * up + circle.rate_beside_round() * axis;
    const Vector3d velocity = -spin.cross(foot);
    BodySpec& disk = add_body(s.scene, cylinder(circle.radius, circle.half_height), -foot);
    disk.placement.rotation = turn;
    disk.velocity = velocity, disk.angular_velocity = spin;
    const Vector3d arm = velocity.cross(up) / circle.round;  // from the middle of the circle
    s.metrics = {
        largest("position", "m", "largest distance of the centre from where it should be",
                [=](const World& w) {
                    const Vector3d now = Eigen::AngleAxisd(circle.round * w.time, up) * arm;
                    return (w.bodies.position[1] + foot - (now - arm)).norm();
                }),
        largest("tilt", "rad", "largest error of the tilt", [=](const World& w) {
            const Vector3d now = geometry_placement(w.bodies, 1).rotation * Vector3d::UnitY();
            return std::acos(now.y()) - circle.tilt;
        })};
    s.tolerance = 3e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

}  // namespace plumb::study
