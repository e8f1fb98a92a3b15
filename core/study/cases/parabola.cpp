// SPDX-License-Identifier: MIT
/// A body that flies.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/judges.h"

namespace plumb::study {

/// x = x₀ + v₀ t + ½ g t². Symplectic Euler's bias is ½ g h t, of substeps h.
Subject parabola() {
    Subject s = begin_subject("parabola", "A ball is thrown, and nothing is in its way",
                              "x₀ + v₀ t + ½ g t²", 2);
    const Vector3d velocity(3, 8, 1), gravity = s.scene.settings.gravity;
    add_body(s.scene, sphere(0.1), Vector3d::Zero()).velocity = velocity;
    s.metrics = {largest("position", "m", "largest error of the position", [=](const World& w) {
        const double t = w.time;
        return (w.bodies.position[0] - velocity * t - 0.5 * gravity * t * t).norm();
    })};
    s.tolerance = 0.01;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

}  // namespace plumb::study
