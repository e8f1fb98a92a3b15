// SPDX-License-Identifier: MIT
/// Balls of skin: one that keeps a volume, one that a pressure blows up.
#include "measure/deformation.h"
#include "reader/build_deformables.h"
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/elastic_laws.h"
#include "study/judges.h"

#include <cmath>

namespace plumb::study {
namespace {

/// Adds a ball of rubber skin.
DeformableSpec& add_ball(Scene& scene, double radius, const Vector3d& at) {
    DeformableSpec& ball = reader::add_soft(scene, reader::balloon(radius, 5, at));
    ball.thickness = 0.001, ball.mass = 1, ball.radius = 0.01;
    ball.elasticity.youngs_modulus = 1e5, ball.elasticity.poissons_ratio = 0.3;
    ball.elasticity.damping = 0.01;
    return ball;
}

}  // namespace

Subject balloon() {
    Subject s = begin_subject(
        "balloon", "A balloon of 1.3 times its volume drops and comes to rest", "V = k V₀", 2);
    add_ground(s.scene);
    add_ball(s.scene, 0.3, {0, 0.5, 0}).volume_ratio = 1.3;
    s.metrics = {mean_over_time("volume", "", "mean error of the volume",
                                [](const World& w) { return volume_errors(w)[0]; })};
    s.tolerance = 1.2e-4;
    return s;
}

Subject pressed_balloon() {
    Subject s = begin_subject("pressed_balloon", "A pressure blows a ball of skin up by a tenth",
                              "p R = E t (λ − 1/λ)/(1 − ν)", 0.5);
    constexpr double kRadius = 0.5, kStretch = 1.1;  // [m]
    s.scene.settings.gravity.setZero();
    s.scene.settings.velocity_iterations = s.scene.settings.position_iterations = 10;
    DeformableSpec& ball = add_ball(s.scene, kRadius, Vector3d::Zero());
    ball.pressure =
        pressure_in_skin(kStretch, kRadius, ball.elasticity.youngs_modulus * ball.thickness,
                         ball.elasticity.poissons_ratio);
    ball.elasticity.bending_stiffness = 0;
    const World start = build_world(s.scene);
    const double rest = volume_inside(start, start.deformables[0]);
    s.metrics = {
        last("growth", "", "error of the radius's growth in the end", [rest](const World& w) {
            const double volume = volume_inside(w, w.deformables[0]);
            return (std::cbrt(volume / rest) - 1) / (kStretch - 1) - 1;
        })};
    s.tolerance = 0.02;
    return s;
}

}  // namespace plumb::study
