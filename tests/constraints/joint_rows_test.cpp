// SPDX-License-Identifier: MIT
/// Rows and coordinates of joints against finite differences.
#include "constraints/joint_rows.h"
#include "constraints/joint_axis.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumb {
namespace {

using test::Random;

constexpr double kTiny = 1e-6;

JointGeometry<double> random_joint(Random& random, double length) {
    JointGeometry<double> joint{};
    joint.r_a = random.vector(), joint.r_b = random.vector(), joint.apart = random.vector();
    for (int k = 0; k < 3; ++k) {
        joint.e[k] = random.direction();
        joint.u[k] = random.direction(), joint.w[k] = random.direction();
    }
    for (int k = 0; k < 6; ++k) joint.lock[k] = 1;
    joint.lever_a = {random.number(0, 1), Vector3d::Zero()};
    joint.lever_b = {random.number(0, 1), Vector3d::Zero()};
    joint.line_share = 1, joint.line_lag = Vector3d::Zero();
    joint.length = length;
    return joint;
}

/// What a row's rate is, of velocities that start from rest.
double rate(const JointRows<double>& rows, int k, const Velocity<double>& a,
            const Velocity<double>& b) {
    const Vector3d along = k < 3 ? rows.e[k] : Vector3d::Zero();
    return along.dot(a.v - b.v) + rows.g_a[k].dot(a.w) - rows.g_b[k].dot(b.w);
}

TEST(JointRows, AreTheDerivativesOfTheirErrors) {
    Random random(11);
    for (const double length : {0.0, 0.7})
        for (int i = 0; i < 100; ++i) {
            const JointGeometry<double> joint = random_joint(random, length);
            const Velocity<double> a{random.vector(), random.vector()},
                b{random.vector(), random.vector()};
            const Velocity<double> back_a{-a.v, -a.w}, back_b{-b.v, -b.w};
            const JointRows<double> rows =
                joint_rows<double>(joint, {Vector3d::Zero(), Vector3d::Zero()},
                                   {Vector3d::Zero(), Vector3d::Zero()}, kTiny);
            const JointRows<double> after = joint_rows<double>(joint, a, b, kTiny),
                                    before = joint_rows<double>(joint, back_a, back_b, kTiny);
            for (int k = 0; k < 6; ++k)
                EXPECT_NEAR((after.c[k] - before.c[k]) / (2 * kTiny), rate(rows, k, a, b), 1e-6)
                    << k;
        }
}

/// Two bodies with a joint's frames, moved on by their velocities for a time.
struct Moving {
    Placement a, b;  ///< the bodies
    Placement frame_a, frame_b;
    Velocity<double> va, vb;

    JointPose at(double time) const {
        const auto moved = [time](const Placement& body, const Velocity<double>& v) {
            return Placement{body.position + time * v.v, turned(body.rotation, time * v.w)};
        };
        const Placement pa = moved(a, va), pb = moved(b, vb);
        return {pa.position + pa.rotation * frame_a.position,
                pb.position + pb.rotation * frame_b.position,
                (pa.rotation * frame_a.rotation).toRotationMatrix(),
                (pb.rotation * frame_b.rotation).toRotationMatrix(),
                pa.position,
                pb.position};
    }
};

Quaterniond random_rotation(Random& random) { return random.rotation(); }

template <class Coordinate>
void expect_rate(Coordinate coordinate, std::uint64_t seed, bool aligned_about_x = false) {
    Random random(static_cast<unsigned>(seed));
    for (int i = 0; i < 100; ++i) {
        Moving m{
            {random.vector(), random_rotation(random)}, {random.vector(), random_rotation(random)},
            {random.vector(), random_rotation(random)}, {random.vector(), Quaterniond::Identity()},
            {random.vector(), random.vector()},         {random.vector(), random.vector()}};
        // a's frame stands turned by up to 1 rad from b's
        const Quaterniond between = aligned_about_x
                                        ? exponential_map({3 * random.vector().x(), 0, 0})
                                        : exponential_map(0.6 * random.vector());
        m.frame_a.rotation = (m.a.rotation.conjugate() * m.b.rotation * between).normalized();
        if (aligned_about_x)
            m.va.w = m.vb.w + random.vector().x() * (m.b.rotation * Vector3d::UnitX());
        const JointCoordinate q = coordinate(m.at(0));
        const double rate =
            q.along.dot(m.va.v - m.vb.v) + q.turn_a.dot(m.va.w) - q.turn_b.dot(m.vb.w);
        const double difference = coordinate(m.at(kTiny)).value - coordinate(m.at(-kTiny)).value;
        if (std::abs(difference) > 1) continue;  // stepped over from π to −π
        EXPECT_NEAR(difference / (2 * kTiny), rate, 1e-5) << i;
    }
}

TEST(JointCoordinates, ChangeAtTheirRates) {
    for (int k = 0; k < 3; ++k) {
        expect_rate([k](const JointPose& p) { return coordinate_along(p, p.axes_b.col(k)); }, 1);
        expect_rate([k](const JointPose& p) { return coordinate_euler(p, k); }, 2);
    }
    for (const int locked : {0, 1, 2})
        for (const int k : {(locked + 1) % 3, (locked + 2) % 3})
            expect_rate([=](const JointPose& p) { return coordinate_of_two(p, locked, k); }, 7);
    expect_rate([](const JointPose& p) { return coordinate_distance(p); }, 3);
    expect_rate([](const JointPose& p) { return coordinate_twist(p); }, 4);
    expect_rate([](const JointPose& p) { return coordinate_swing(p); }, 5);
    expect_rate([](const JointPose& p) { return coordinate_about(p, 0); }, 6, true);
}

TEST(JointCoordinates, OfEulerAnglesAreThoseOfTheRotation) {
    Random random(7);
    for (int i = 0; i < 50; ++i) {
        const Vector3d angles = 1.5 * random.direction();
        JointPose pose{};
        pose.axes_b = random_rotation(random).toRotationMatrix();
        const Quaterniond r = exponential_map({angles.x(), 0, 0}) *
                              exponential_map({0, angles.y(), 0}) *
                              exponential_map({0, 0, angles.z()});
        pose.axes_a = pose.axes_b * r.toRotationMatrix();
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(coordinate_euler(pose, k).value, angles[k], 1e-12);
    }
}

/// Limits hold where they were drawn, also beyond half a turn and where the middle angle passes
/// 90°.
TEST(JointCoordinates, OfLimitedTurnsAreThoseWithinTheirLimits) {
    Random random(9);
    for (int i = 0; i < 300; ++i) {
        Joint ball;
        Vector3d angles;
        for (int k = 0; k < 3; ++k) {
            const double middle = random.number(-4, 4);
            ball.ranges[k] = {middle - 1.2, middle + 1.2};
            angles[k] = middle + random.number(-1.2, 1.2);
        }
        if (std::abs(std::cos(angles.y())) < 0.05) continue;
        JointPose pose{};
        pose.axes_b = random_rotation(random).toRotationMatrix();
        const auto turn_by = [&](const Vector3d& by) {
            const Quaterniond r = exponential_map({by.x(), 0, 0}) *
                                  exponential_map({0, by.y(), 0}) * exponential_map({0, 0, by.z()});
            pose.axes_a = pose.axes_b * r.toRotationMatrix();
        };
        for (int k = 0; k < 3; ++k) {
            turn_by(angles);
            const JointCoordinate q = joint_coordinate(ball, pose, kTurnX + k);
            EXPECT_NEAR(q.value, angles[k], 1e-10);
            // the rate of one angle alone is that angle's
            turn_by(angles + kTiny * Vector3d::Unit(k));
            const Matrix3d before = pose.axes_a;
            turn_by(angles - kTiny * Vector3d::Unit(k));
            const Matrix3d step = (before - pose.axes_a) * before.transpose() / (2 * kTiny);
            const Vector3d w(step(2, 1), step(0, 2), step(1, 0));
            for (int other = 0; other < 3; ++other) {
                turn_by(angles);
                const JointCoordinate p = joint_coordinate(ball, pose, kTurnX + other);
                EXPECT_NEAR(p.turn_a.dot(w), other == k ? 1 : 0, 1e-4);
            }
        }
        Joint universal;
        universal.kind = JointKind::universal, universal.locked[kTurnZ] = true;
        Joint cone;
        cone.kind = JointKind::cone_twist;
        for (Joint* joint : {&universal, &cone}) joint->ranges[0] = ball.ranges[0];
        turn_by({angles.x(), 0, 0});
        EXPECT_NEAR(joint_coordinate(universal, pose, kTurnX).value, angles.x(), 1e-10);
        EXPECT_NEAR(joint_coordinate(cone, pose, kTurnX).value, angles.x(), 1e-10);
    }
}

/// One limit alone tells nothing of which angles a pose has: the middle one, which a spring may
/// hold, does not jump by half a turn with the first.
TEST(JointCoordinates, OneLimitAloneChoosesNoAngles) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    for (const TurnRange& range : {TurnRange{-0.5, kNone}, TurnRange{-kNone, 0.5}})
        for (const double angle : {-3.1, -2.0, 0.3, 2.0, 3.1}) {
            Joint ball;
            ball.ranges[0] = range;
            JointPose pose{};
            pose.axes_b.setIdentity();
            pose.axes_a = exponential_map({angle, 0, 0}).toRotationMatrix();
            EXPECT_NEAR(joint_coordinate(ball, pose, kTurnX).value, angle, 1e-10);
            EXPECT_NEAR(joint_coordinate(ball, pose, kTurnY).value, 0, 1e-10);
            EXPECT_NEAR(joint_coordinate(ball, pose, kTurnZ).value, 0, 1e-10);
        }
}

/// A universal joint that turns right over leaves neither of its angles behind.
TEST(JointCoordinates, OfTwoTurnsGoFromMinusPiToPi) {
    Random random(8);
    for (int i = 0; i < 100; ++i) {
        const int locked = i % 3, next = (locked + 1) % 3, last = (locked + 2) % 3;
        const double first = random.number(-3.1, 3.1), second = random.number(-3.1, 3.1);
        JointPose pose{};
        pose.axes_b = random_rotation(random).toRotationMatrix();
        const Quaterniond r = exponential_map(first * Vector3d::Unit(next)) *
                              exponential_map(second * Vector3d::Unit(last));
        pose.axes_a = pose.axes_b * r.toRotationMatrix();
        const JointCoordinate a = coordinate_of_two(pose, locked, next),
                              b = coordinate_of_two(pose, locked, last);
        EXPECT_NEAR(a.value, first, 1e-12);
        EXPECT_NEAR(b.value, second, 1e-12);
        EXPECT_LT((a.turn_a - pose.axes_b.col(next)).norm(), 1e-12);
        EXPECT_LT((b.turn_a - pose.axes_a.col(last)).norm(), 1e-12);
    }
}

}  // namespace
}  // namespace plumb
