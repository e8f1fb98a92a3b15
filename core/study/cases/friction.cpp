// SPDX-License-Identifier: MIT
/// A block that slides, sticks, and comes to a stand.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/judges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::study {
namespace {

constexpr double kDegree = std::numbers::pi / 180, kAngle = 30 * kDegree;
const Vector3d kHalf(0.2, 0.1, 0.2);  // of the block [m]

/// Puts a block of body 1 on ground that climbs by `angle` [rad]; `friction` is that of both.
BodySpec& add_block(Scene& scene, double angle, double friction) {
    scene.materials[0].friction = friction;
    add_slope(scene, angle);
    BodySpec& block = add_body(scene, box(kHalf), slope_of(angle) * Vector3d(0, kHalf.y(), 0));
    block.placement.rotation = slope_of(angle);
    return block;
}

/// Way of the block down the slope [m].
double way_down(const World& w) {
    return -(slope_of(kAngle) * Vector3d::UnitX()).dot(w.bodies.position[1]);
}

/// A block of speed v₀ under friction μ comes to a stand after v₀²/2μg.
struct Braking {
    double speed = 3, friction = 0.5;  ///< [m/s]
    double deceleration = friction * kGravity, distance = 0.5 * speed * speed / deceleration;

    double position(double time) const {
        const double t = std::min(time, speed / deceleration);
        return speed * t - 0.5 * deceleration * t * t;
    }
};

}  // namespace

Subject slope_slides() {
    Subject s = begin_subject("slope_slides", "A block slides down a slope of 30°, friction 0.3",
                              "s = ½ g (sin θ − μ cos θ) t²", 2);
    const double friction = 0.3;
    add_block(s.scene, kAngle, friction);
    const double rate = kGravity * (std::sin(kAngle) - friction * std::cos(kAngle));
    s.metrics = {largest("way", "m", "largest error of the way", [rate](const World& w) {
        return way_down(w) - 0.5 * rate * w.time * w.time;
    })};
    s.tolerance = 3e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

Subject slope_sticks() {
    Subject s =
        begin_subject("slope_sticks",
                      "A block stays on a slope that is half a degree below the angle of friction",
                      "it does not move", 5);
    add_block(s.scene, kAngle, std::tan(kAngle + 0.5 * kDegree));
    const Vector3d start = s.scene.bodies[1].placement.position;
    s.metrics = {
        largest("creep", "m", "largest distance from where it was put",
                [start](const World& w) { return (w.bodies.position[1] - start).norm(); })};
    s.tolerance = 1e-9;
    return s;
}

Subject braking() {
    Subject s = begin_subject("braking", "A block slides on level ground until friction stops it",
                              "after v₀²/2μg", 1.5);
    const Braking law;
    add_block(s.scene, 0, law.friction).velocity = {law.speed, 0, 0};
    s.metrics = {
        last("distance", "", "error of the distance, where it has come to a stand",
             [law](const World& w) { return w.bodies.position[1].x() / law.position(w.time) - 1; }),
        largest("position", "m", "largest error of the position",
                [law](const World& w) { return w.bodies.position[1].x() - law.position(w.time); })};
    s.tolerance = 2e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

}  // namespace plumb::study
