// SPDX-License-Identifier: MIT
/// What tests of edits share.
#pragma once

#include "support/scenes.h"

#include <string>

namespace plumb::test {

inline constexpr double kStep = 0.01;  ///< of a scene that does not say [s]

inline void make_steps(Simulation& s, int n) {
    for (int i = 0; i < n; ++i) {
        const StepReport report = s.step();
        ASSERT_TRUE(report.finite && !report.collider_failed);
    }
}

/// Cubes and balls on the ground that fall on one another, 4 × 3 × 3, a metre aside of the origin.
inline Scene heap(const Settings& settings = {}) {
    Scene s;
    s.settings = settings;
    add_ground(s);
    const std::uint32_t cube = add_geometry(s, box(0.2, 0.2, 0.2));
    const std::uint32_t ball = add_geometry(s, sphere(0.2));
    for (int i = 0; i < 36; ++i) {
        BodySpec body;
        body.geometry = i % 3 == 1 ? ball : cube;
        body.placement.position = {1 + 0.41 * (i % 3) + 0.03 * (i % 5), 0.25 + 0.45 * (i / 9),
                                   0.41 * (i / 3 % 3) + 0.02 * (i % 7)};
        s.bodies.push_back(body);
    }
    return s;
}

/// A chain of three boxes and a driven wheel that hang in the air, beside the heap.
inline void add_machine(Scene& s) {
    const auto first = static_cast<std::uint32_t>(s.bodies.size());
    for (int i = 0; i < 4; ++i) add_body(s, box(0.2, 0.05, 0.1), {-3 + 0.5 * i, 3, 0});
    for (std::uint32_t i = 0; i < 3; ++i) {
        JointSpec joint;
        joint.kind = i == 1 ? JointKind::hinge : JointKind::ball;
        joint.body_a = first + i;
        joint.body_b = i == 0 ? kNoIndex : first + i - 1;
        joint.anchor = {-3.25 + 0.5 * i, 3, 0};
        joint.frame = rotation_between(Vector::UnitX(), Vector::UnitZ());
        s.joints.push_back(joint);
    }
    JointSpec motor;
    motor.kind = JointKind::hinge;
    motor.body_a = first + 3;
    motor.anchor = {-1.5, 3, 0};
    motor.axes[kTurnX].motor.mode = MotorMode::velocity;
    motor.axes[kTurnX].motor.target = 3;
    s.joints.push_back(motor);
}

/// A body of a geometry that the simulation has.
inline BodySpec body_of(std::uint32_t geometry, const Vector& position) {
    BodySpec body;
    body.geometry = geometry;
    body.placement.position = position;
    return body;
}

inline std::uint64_t hash_of(const Simulation& s) { return state_hash(s.world()); }

/// Where a body is and how it moves, bit for bit.
inline bool same_state(const Simulation& s, std::uint32_t a, const Simulation& t, std::uint32_t b) {
    const BodyState x = s.body_state(a), y = t.body_state(b);
    return x.placement.position == y.placement.position &&
           x.placement.rotation.coeffs() == y.placement.rotation.coeffs() &&
           x.velocity == y.velocity && x.angular_velocity == y.angular_velocity;
}

/// Expects an exception of this kind whose sentence holds these words.
template <class Error, class Edit>
void expect_refusal(Edit&& edit, const std::string& words) {
    try {
        edit();
        FAIL() << "no exception; expected \"" << words << "\"";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

}  // namespace plumb::test
