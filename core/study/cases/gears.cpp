// SPDX-License-Identifier: MIT
/// Two wheels, geared.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/judges.h"
#include "ties/joint_state.h"

namespace plumb::study {

/// q₂ = r q₁ and the torque τ on the first: q₁″ = τ / (I₁ + r² I₂).
Subject gears() {
    Subject s = begin_subject("gears", "A torque turns a wheel, and by a gear another",
                              "α₁ = τ / (I₁ + r² I₂)", 2);
    constexpr double kTorque = 0.5, kRatio = -2, kInertia[] = {0.05, 0.02};  // [N m], [kg m²]
    for (const std::uint32_t i : {0u, 1u}) {
        const Vector3d at(0, 0, 0.5 * i);
        BodySpec& wheel = add_body(s.scene, box({0.02, 0.1, 0.1}), at);
        wheel.mass = 5;
        wheel.inertia = Vector3d(kInertia[i], 0.6 * kInertia[i], 0.6 * kInertia[i]);
        add_joint(s.scene, JointKind::hinge, i, kNoIndex, at);
    }
    s.scene.bodies[0].torque.x() = kTorque;
    CouplingSpec gear;
    gear.joint_a = 0, gear.joint_b = 1, gear.ratio = kRatio;
    s.scene.couplings.push_back(gear);

    const double law = kTorque / (kInertia[0] + kRatio * kRatio * kInertia[1]);
    s.metrics = {largest("angle", "rad", "largest error of the angle of the first",
                         [law](const World& w) {
                             const double angle = joint_coordinate(w, 0, kTurnX).value;
                             return angle - 0.5 * law * w.time * w.time;
                         }),
                 last("speed", "", "error of the speed in the end",
                      [law](const World& w) {
                          return w.bodies.angular_velocity[0].x() / (law * w.time) - 1;
                      }),
                 largest("mesh", "rad", "how far the second is at most from where the first has it",
                         [](const World& w) {
                             return joint_coordinate(w, 1, kTurnX).value -
                                    kRatio * joint_coordinate(w, 0, kTurnX).value;
                         })};
    s.tolerance = 5e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

}  // namespace plumb::study
