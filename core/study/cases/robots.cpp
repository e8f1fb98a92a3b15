// SPDX-License-Identifier: MIT
/// Robots that stand.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/contact_forces.h"
#include "study/judges.h"

#include <algorithm>

namespace plumb::study {
namespace {

constexpr double kTorso = 20, kThigh = 1.5, kShank = 0.8;            // [kg]
constexpr double kStiffness = 400, kDamping = 10;                    // [N m/rad], [N m s/rad]
constexpr double kFoot = 0.04;                                       // radius of a foot [m]
constexpr double kLoad = (kTorso / 4 + kThigh + kShank) * kGravity;  // on a foot [N]

/// Torque about z of a force (0, y, 0) at `point` about `pivot` [N m].
double torque(const Vector3d& point, const Vector3d& pivot, double y) {
    return (point.x() - pivot.x()) * y;
}

/// A hinge about z whose spring turns `a` with a torque [N m] as the bodies stand.
void add_spring_hinge(Scene& scene, std::uint32_t a, std::uint32_t b, const Vector3d& at,
                      double torque_on_a) {
    JointSpec& joint = add_joint(scene, JointKind::hinge, a, b, at);
    joint.frame = axis_along(Vector3d::UnitZ());
    JointAxisSpec& axis = joint.axes[kTurnX];
    axis.stiffness = kStiffness, axis.damping = kDamping;
    axis.rest = torque_on_a / kStiffness;
}

/// A leg below `hip` whose knee points to `forward` (±1) along x, and whose foot, a ball, stands
/// straight below the hip.
void add_leg(Scene& scene, std::uint32_t torso, const Vector3d& hip, double forward) {
    const Vector3d foot(hip.x(), kFoot, hip.z());
    const Vector3d knee = 0.5 * (hip + foot) + Vector3d(0.12 * forward, 0, 0);
    const auto thigh = static_cast<std::uint32_t>(scene.bodies.size()), shank = thigh + 1;
    const Vector3d along = hip - knee, across = knee - foot;
    BodySpec& upper = add_body(scene, capsule(0.03, along.norm() / 2), 0.5 * (hip + knee));
    upper.mass = kThigh;
    upper.placement.rotation = rotation_between(Vector3d::UnitY(), along.normalized());
    BodySpec& lower = add_body(scene, capsule(kFoot, across.norm() / 2), 0.5 * (knee + foot));
    lower.mass = kShank;
    lower.placement.rotation = rotation_between(Vector3d::UnitY(), across.normalized());
    const Vector3d thigh_centre = 0.5 * (hip + knee), shank_centre = 0.5 * (knee + foot);
    const double on_shank =
        -torque(foot, knee, kLoad) - torque(shank_centre, knee, -kShank * kGravity);
    const double on_thigh = -torque(foot, hip, kLoad) -
                            torque(shank_centre, hip, -kShank * kGravity) -
                            torque(thigh_centre, hip, -kThigh * kGravity);
    add_spring_hinge(scene, thigh, torso, hip, on_thigh);
    add_spring_hinge(scene, shank, thigh, knee, on_shank);
}

}  // namespace

/// Springs turn the hips and knees by what statics asks for as they are put; so nothing moves.
Subject robot() {
    Subject s = begin_subject("robot", "A robot stands on four legs with springs in its joints",
                              "statics: each foot bears a quarter, and nothing moves", 2);
    constexpr double kHip = 0.55;  // height [m]
    add_body(s.scene, box(0.35, 0.08, 0.15), {0, kHip + 0.1, 0}).mass = kTorso;
    for (const double x : {-0.3, 0.3})
        for (const double z : {-0.2, 0.2}) add_leg(s.scene, 0, {x, kHip, z}, x < 0 ? 1 : -1);
    add_ground(s.scene);
    s.metrics = {shift_metric("farthest that a part has moved, of the height", kHip),
                 last("force", "", "largest error of a foot's load in the end", [](const World& w) {
                     double worst = 0;
                     for (const std::uint32_t shank : {2u, 4u, 6u, 8u})
                         worst =
                             std::max(worst, size_of(contact_force_on(w, shank).y() / kLoad - 1));
                     return worst;
                 })};
    s.tolerance = 1.5e-7;
    return s;
}

}  // namespace plumb::study
