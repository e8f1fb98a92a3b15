// SPDX-License-Identifier: MIT
/// A rod that swings about its end.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/elliptic.h"
#include "study/judges.h"

#include <cmath>
#include <numbers>

namespace plumb::study {
namespace {

constexpr double kHalfLength = 0.5, kHalfWidth = 0.02;  // [m]

/// θ(t) = 2 asin(k sn(K − ω t; k)), k = sin(θ₀/2): the angle from the vertical of a pendulum let go
/// at θ₀, where ω is the rate of small swings (Landau, Lifshitz: Mechanics, §11).
double angle_of_pendulum(double start, double rate, double time) {
    const double k = std::sin(start / 2), quarter = std::comp_ellint_1(k);
    const Elliptic e = jacobi(quarter - rate * time, k);
    return 2 * std::asin(k * e.sn);
}

}  // namespace

Subject pendulum() {
    Subject s = begin_subject("pendulum", "A rod of 1 m swings about its end, let go at 90°",
                              "the angle by Jacobi's elliptic functions", 4);
    add_body(s.scene, box({kHalfLength, kHalfWidth, kHalfWidth}), {kHalfLength, 0, 0});
    add_joint(s.scene, JointKind::ball, 0, kNoIndex, Eigen::Vector3d::Zero());

    const double per_mass = (4 * kHalfLength * kHalfLength + kHalfWidth * kHalfWidth) / 3;
    const double rate = std::sqrt(kGravity * kHalfLength / per_mass);
    s.metrics = {largest("angle", "rad", "largest error of the angle", [rate](const World& w) {
        const Vector3d& x = w.bodies.position[0];
        return std::atan2(x.x(), -x.y()) - angle_of_pendulum(std::numbers::pi / 2, rate, w.time);
    })};
    s.tolerance = 3e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

}  // namespace plumb::study
