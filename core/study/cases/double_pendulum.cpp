// SPDX-License-Identifier: MIT
/// Two rods, one hung from the other's end.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/judges.h"
#include "study/two_rods.h"

#include <cmath>
#include <numbers>

namespace plumb::study {
namespace {

constexpr double kHalfLength = 0.5, kHalfWidth = 0.02;  // [m]

/// Integrates the equations of motion beside the run.
class TipJudge : public Judge {
public:
    void look(const World& w) override {
        exact_ = rods_.advance(exact_, w.time - time_);
        time_ = w.time;
        Vector3d tip = Vector3d::Zero();
        for (const double angle : exact_.angle)
            tip += rods_.length * Vector3d(std::sin(angle), -std::cos(angle), 0);
        const Vector3d now = w.bodies.position[1] + w.bodies.orientation[1] * end_;
        error_ = std::max(error_, size_of((now - tip).norm()));
    }
    double error() const override { return error_; }

private:
    TwoRods rods_{2 * kHalfLength, (kHalfLength * kHalfLength + kHalfWidth * kHalfWidth) / 3,
                  kGravity};
    RodAngles exact_{{std::numbers::pi / 2, std::numbers::pi / 2}, {}};
    double time_ = 0, error_ = 0;
    Vector3d end_{kHalfLength, 0, 0};
};

}  // namespace

Subject double_pendulum() {
    Subject s =
        begin_subject("double_pendulum", "Two rods of 1 m, one hung from the other, let go at 90°",
                      "Runge and Kutta's fourth order in steps of 0.1 ms", 2);
    for (const std::uint32_t i : {0u, 1u}) {
        const double start = 2 * kHalfLength * i;
        add_body(s.scene, box({kHalfLength, kHalfWidth, kHalfWidth}), {start + kHalfLength, 0, 0});
        add_joint(s.scene, JointKind::ball, i, i == 0 ? kNoIndex : 0, {start, 0, 0});
    }
    s.metrics = {{"tip", "m", "largest distance of the lower tip from where it should be",
                  [] { return std::make_unique<TipJudge>(); }}};
    s.tolerance = 8e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

}  // namespace plumb::study
