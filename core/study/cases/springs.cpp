// SPDX-License-Identifier: MIT
/// A column of bodies on joints that give way.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/judges.h"

#include <array>
#include <cmath>
#include <numbers>

namespace plumb::study {
namespace {

/// N bodies of mass m below each other, each joint of compliance a. Let go unstretched, the column
/// swings about the elongation a m g N (N + 1)/2, in the modes of a row of springs:
///
///   ωⱼ = 2/√(a m) sin(φⱼ/2),  u(i) ~ sin(i φⱼ),  φⱼ = (2j − 1) π / (2N + 1)
struct Column {
    static constexpr int kCount = 5;
    double mass = 1, compliance = 1e-3;  ///< [kg], [m/N]

    double elongation() const { return compliance * mass * kGravity * kCount * (kCount + 1) / 2; }
    /// How far the lowest body has come down [m].
    double lowered(double time) const {
        double sum = 0;
        for (int j = 1; j <= kCount; ++j) {
            const double phi = (2 * j - 1) * std::numbers::pi / (2 * kCount + 1);
            const double rate = 2 / std::sqrt(compliance * mass) * std::sin(phi / 2);
            double push = 0;
            for (int i = 1; i <= kCount; ++i) push += kGravity * std::sin(i * phi);
            const double part = push / (0.25 * (2 * kCount + 1)) / (rate * rate);
            sum += part * std::sin(kCount * phi) * (1 - std::cos(rate * time));
        }
        return sum;
    }
};

constexpr double kSpacing = 0.3;  // [m]

/// How much too far the lowest body has come down, of the elongation.
double too_far(const Column& column, const World& w) {
    const double down = -kSpacing * Column::kCount - w.bodies.position.back().y();
    return (down - column.lowered(w.time)) / column.elongation();
}

}  // namespace

Subject springs() {
    Subject s = begin_subject("springs", "Five bodies swing below each other on compliant joints",
                              "the modes of a row of springs, about a m g N (N + 1)/2", 3);
    const Column column;
    s.scene.settings.forbid = {"contacts"};
    for (std::uint32_t i = 0; i < Column::kCount; ++i) {
        const Vector3d at(0, -kSpacing * (i + 1), 0);
        add_body(s.scene, sphere(0.05), at).mass = column.mass;
        add_joint(s.scene, JointKind::ball, i, i > 0 ? i - 1 : kNoIndex, at).compliance =
            column.compliance;
    }
    s.metrics = {largest("position", "", "largest error of the lowest body, of the elongation",
                         [column](const World& w) { return too_far(column, w); }),
                 of_mean("elongation", "", "error of the mean elongation",
                         [column](const World& w) { return too_far(column, w); })};
    s.tolerance = 6e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

}  // namespace plumb::study
