// SPDX-License-Identifier: MIT
/// What is wrong with a joint or a coupling by its own numbers, in a sentence. Whoever takes joints
/// asks here, files and programs alike; what depends on the bodies is asked where they are known.
#pragma once

#include "scene/joint_freedom.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace plumb {

/// Where a joint is wrong, and why.
struct JointFault {
    std::uint32_t axis = kJointAxes;  ///< that it is about; kJointAxes: of the joint as a whole
    std::string key;                  ///< as files have it: "limits", "motor/max"; may be empty
    std::string sentence;
};

/// The furthest that a joint may be told to go or to move [m], [rad], [m/s], [rad/s], and the
/// greatest stiffness, friction and so on.
inline constexpr double kFurthestTarget = 1e9, kGreatestStrength = 1e15;

/// What a swing may be; half a turn, as people round it up [rad].
inline constexpr double kGreatestSwing = 3.142;

namespace joint_faults {

/// Looks at one axis of a joint; the first fault found stays.
class AxisCheck {
public:
    AxisCheck(const JointSpec& joint, std::uint32_t axis)
        : joint_(joint), spec_(joint.axes[axis]), axis_(axis) {}

    std::optional<JointFault> fault() {
        check_limits();
        check_strengths();
        if (spec_.motor.mode != MotorMode::none) check_motor();
        if (is_never_negative(joint_.kind, axis_)) check_size();
        if (acts() && !is_free(joint_, axis_))
            blame("",
                  "this kind of joint has locked, or does not have, the axis on which a limit, a "
                  "motor, a spring, friction or a greatest speed acts");
        return fault_;
    }

private:
    void blame(const std::string& key, const std::string& sentence) {
        if (!fault_) fault_ = {axis_, key, sentence};
    }
    void expect(bool good, const std::string& key, const std::string& sentence) {
        if (!good) blame(key, sentence);
    }

    bool acts() const {
        return std::isfinite(spec_.lower) || std::isfinite(spec_.upper) ||
               spec_.motor.mode != MotorMode::none || spec_.stiffness > 0 || spec_.damping > 0 ||
               spec_.friction > 0 || std::isfinite(spec_.greatest_speed);
    }

    void check_limits() {
        constexpr double any = std::numeric_limits<double>::infinity();
        expect(!(spec_.lower > spec_.upper), "limits", "the lower limit is above the upper one");
        expect(spec_.lower < any && spec_.upper > -any, "limits",
               "limits must be numbers, or infinite to their own side");
        const bool wide = spec_.upper - spec_.lower >= 2 * std::numbers::pi;
        expect(!(wide && std::isfinite(spec_.upper - spec_.lower) && is_one_of_several_turns()),
               "limits",
               "the angles of several free turns are known but for whole turns, so limits a whole "
               "turn apart or more never hold; leave them out");
    }

    bool is_one_of_several_turns() const {
        if (axis_ < kTurnX || joint_.kind == JointKind::distance) return false;
        const JointAxes locked = locked_axes(joint_);
        return !(locked[kTurnX] || locked[kTurnY]) || !(locked[kTurnY] || locked[kTurnZ]) ||
               !(locked[kTurnZ] || locked[kTurnX]);
    }

    void check_strengths() {
        const auto strength = [&](double value, const char* key) {
            expect(value >= 0 && value <= kGreatestStrength, key, "must be from 0 to 1e15");
        };
        strength(spec_.stiffness, "spring/stiffness"), strength(spec_.damping, "spring/damping");
        strength(spec_.friction, "friction");
        expect(std::abs(spec_.rest) <= kFurthestTarget, "spring/rest", "must be within ±1e9");
        expect(spec_.greatest_speed >= 0, "max_speed", "must be 0 or above");
    }

    void check_motor() {
        const JointMotor& m = spec_.motor;
        expect(m.mode == MotorMode::velocity || m.mode == MotorMode::position, "motor",
               "a motor has either a velocity or a position");
        const std::string target =
            m.mode == MotorMode::velocity ? "motor/velocity" : "motor/position";
        expect(std::abs(m.target) <= kFurthestTarget, target, "must be within ±1e9");
        expect(m.greatest >= 0, "motor/max", "must be 0 or above");
        expect(m.frequency >= 1e-6 && m.frequency <= 1e6, "motor/frequency",
               "must be from 1e-6 to 1e6");
        expect(m.damping_ratio >= 0 && m.damping_ratio <= 1e6, "motor/damping_ratio",
               "must be from 0 to 1e6");
        for (std::size_t i = 0; i < m.keys.size(); ++i) {
            const std::string key = target + "/" + std::to_string(i);
            expect(m.keys[i].time >= 0 && m.keys[i].time <= 1e9, key + "/0",
                   "must be a time from 0 to 1e9");
            expect(i == 0 || m.keys[i].time > m.keys[i - 1].time, key + "/0",
                   "must be later than the time before it");
            expect(std::abs(m.keys[i].value) <= kFurthestTarget, key + "/1", "must be within ±1e9");
        }
    }

    void check_size() {
        const bool swings = axis_ == kTurnY;
        const bool open_below = std::isinf(spec_.lower), open_above = std::isinf(spec_.upper);
        expect(!swings || spec_.motor.mode == MotorMode::none, "motor",
               "a swing has no direction that a motor could take");
        if (open_below && open_above) return;
        if (swings)
            expect((open_below || spec_.lower == 0) && spec_.upper >= 0 &&
                       spec_.upper <= kGreatestSwing,
                   "limits",
                   "a swing begins at 0, is never negative and at most half a turn, so its limits "
                   "are [0, greatest] with a greatest up to 3.142; to either side by 1 is [0, 1]");
        else
            expect((open_below || spec_.lower >= 0) && spec_.upper >= 0, "limits",
                   "a distance is never negative, so its limits are [least, greatest], each 0 or "
                   "above, or null");
    }

    const JointSpec& joint_;
    const JointAxisSpec& spec_;
    std::uint32_t axis_;
    std::optional<JointFault> fault_;
};

/// Of a joint but for its axes.
inline std::optional<JointFault> fault_of_whole(const JointSpec& joint) {
    std::optional<JointFault> fault;
    const auto expect = [&](bool good, const char* key, const char* sentence) {
        if (!good && !fault) fault = {kJointAxes, key, sentence};
    };
    const auto near = [](const Eigen::Vector3d& v) {
        return v.allFinite() && v.cwiseAbs().maxCoeff() <= kFurthestTarget;
    };
    const auto strength = [](double x) { return x >= 0 && x <= kGreatestStrength; };
    expect(is_known(joint.kind), "type", "there is no such kind of joint");
    expect(near(joint.anchor), "anchor", "must be finite numbers within ±1e9");
    expect(!joint.anchor_b || joint.kind == JointKind::distance, "anchor_b",
           "only a distance joint has a second anchor");
    expect(near(joint.anchor_b.value_or(joint.anchor)), "anchor_b",
           "must be finite numbers within ±1e9");
    expect(joint.frame.coeffs().allFinite() && std::abs(joint.frame.norm() - 1) <= 1e-6, "axis",
           "the joint's frame must be a unit quaternion");
    expect(strength(joint.compliance), "compliance", "must be from 0 to 1e15");
    expect(strength(joint.angular_compliance), "angular_compliance", "must be from 0 to 1e15");
    expect(joint.breaking_force > 0, "breaking_force", "must be above 0");
    expect(joint.breaking_torque > 0, "breaking_torque", "must be above 0");
    return fault;
}

}  // namespace joint_faults

/// The first fault of a joint, if it has any.
inline std::optional<JointFault> find_fault(const JointSpec& joint) {
    if (auto fault = joint_faults::fault_of_whole(joint)) return fault;
    for (std::uint32_t axis = 0; axis < kJointAxes; ++axis)
        if (auto fault = joint_faults::AxisCheck(joint, axis).fault()) return fault;
    return std::nullopt;
}

/// The first fault of a coupling, whose key is of the coupling; whether its joints are free in its
/// axes is asked where they are known.
inline std::optional<JointFault> find_fault(const CouplingSpec& coupling) {
    const auto fault = [](const char* key, const char* sentence) {
        return JointFault{kJointAxes, key, sentence};
    };
    if (coupling.joint_a == coupling.joint_b && coupling.axis_a == coupling.axis_b)
        return fault("joints", "an axis cannot be coupled to itself");
    if (!(std::abs(coupling.ratio) <= kFurthestTarget) || coupling.ratio == 0)
        return fault("ratio", "must be a finite number other than 0, within ±1e9");
    if (!(std::abs(coupling.offset.value_or(0)) <= kFurthestTarget))
        return fault("offset", "must be a finite number within ±1e9");
    return std::nullopt;
}

}  // namespace plumb
