// SPDX-License-Identifier: MIT
/// A scene in which everything that deformables know of has work.
#pragma once

#include "scene/build.h"
#include "support/soft.h"

namespace plumb::test {

/// In a wind, on the ground, a kinematic plate and boxes: a cloth that is held at one side, a
/// balloon, a balloon with a pressure, a solid, a rope between two bodies, links of all
/// kinds, and joints of bodies that fall on the cloth.
inline Scene soft_scene() {
    Scene s;
    s.settings.substeps = 4;
    s.settings.wind = Eigen::Vector3d(0.5, 0, -0.3), s.settings.gusts = {0.5, 0.1, 0.5};
    add_ground(s);
    add_body(s, box(1.5, 0.1, 1.5), {0, 0.4, 0}, Motion::kinematic).angular_velocity = {0, 0.5, 0};
    for (int i = 0; i < 12; ++i)
        add_body(s, i % 2 ? box(0.1, 0.15, 0.1) : sphere(0.12),
                 {0.4 * (i % 4) - 0.6, 2.2 + 0.3 * (i / 4), 0.4 * (i % 3) - 0.4});
    const auto place = [&](DeformableSpec spec, double mass) {
        spec.mass = mass, spec.radius = 0.02;
        spec.elasticity.youngs_modulus = 1e5, spec.elasticity.damping = 0.01;
        add_soft(s, std::move(spec));
    };
    place(sheet({12, 12}, {2, 2}, {0, 1.8, 0}), 1);
    place(balloon(0.25, 4, {-0.6, 0.8, 0}), 0.3);
    place(balloon(0.2, 3, {0.6, 0.75, 0.5}), 0.3);
    s.deformables.back().pressure = 100;
    place(block({0.2, 0.15, 0.2}, {3, 2, 3}, {0.5, 0.7, -0.5}), 3);
    place(rope({-0.6, 2.4, 0.6}, {0.6, 2.4, 0.6}, 12), 0.3);
    s.deformables.back().thickness = 0.02;
    hold(s, 0, {0, 6, 12});
    hold(s, 0, {156, 168}).compliance = 1e-3;
    hold(s, 4, {0}, 2);
    hold(s, 4, {12}, 5);
    add_link(s, point_of(0, 90), point_of(1, 4)).longest = 1.2;
    add_link(s, on_body(3, {-0.2, 2.2, -0.1}), on_body(4, {0.2, 2.2, 0}));
    add_link(s, on_body(6, {-0.6, 2.5, 0}), in_the_world({-0.6, 3, 0})).compliance = 1e-3;
    s.links.back().damping = 10;
    JointSpec joint;
    joint.body_a = 3, joint.body_b = 2, joint.anchor = {-0.4, 2.2, -0.2};
    s.joints.push_back(joint);
    joint.kind = JointKind::hinge;
    joint.body_a = 5, joint.body_b = 4, joint.anchor = {0.4, 2.2, 0};
    joint.axes[kTurnX].lower = -0.3, joint.axes[kTurnX].upper = 0.3;
    s.joints.push_back(joint);
    return s;
}

/// A heavy ball that flies through a free sheet.
inline Scene shot_through_a_sheet() {
    Scene s;
    s.settings.gravity.setZero();
    DeformableSpec& spec = add_soft(s, sheet({10, 10}, {1, 1}));
    spec.mass = 0.1, spec.tearing_strain = 0.05, spec.elasticity.youngs_modulus = 1e4;
    BodySpec& ball = add_body(s, sphere(0.1), {0.03, 0.3, 0.02});
    ball.velocity = {0, -20, 0}, ball.mass = 5;
    return s;
}

}  // namespace plumb::test
