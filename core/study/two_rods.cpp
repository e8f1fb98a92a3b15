// SPDX-License-Identifier: MIT
#include "study/two_rods.h"

#include <cmath>

namespace plumb::study {
namespace {

RodAngles sum(RodAngles s, const RodAngles& change, double time) {
    for (int i = 0; i < 2; ++i) {
        s.angle[i] += time * change.angle[i];
        s.rate[i] += time * change.rate[i];
    }
    return s;
}

}  // namespace

/// Lagrange's equations with l the length and I the inertia about a centre:
///   (I + 5/4 l²) θ₁″ + ½ l² cos(θ₁ − θ₂) θ₂″ = −½ l² sin(θ₁ − θ₂) θ₂′² − 3/2 g l sin θ₁
///   ½ l² cos(θ₁ − θ₂) θ₁″ + (I + ¼ l²) θ₂″ = ½ l² sin(θ₁ − θ₂) θ₁′² − ½ g l sin θ₂
RodAngles TwoRods::change(const RodAngles& s) const {
    const double square = length * length, apart = s.angle[0] - s.angle[1];
    const double m00 = inertia + 1.25 * square, m11 = inertia + 0.25 * square,
                 m01 = 0.5 * square * std::cos(apart);
    const double pull = 0.5 * square * std::sin(apart), weight = 0.5 * gravity * length;
    const double f0 = -pull * s.rate[1] * s.rate[1] - 3 * weight * std::sin(s.angle[0]),
                 f1 = pull * s.rate[0] * s.rate[0] - weight * std::sin(s.angle[1]);
    const double determinant = m00 * m11 - m01 * m01;
    return {s.rate, {(m11 * f0 - m01 * f1) / determinant, (m00 * f1 - m01 * f0) / determinant}};
}

RodAngles TwoRods::advance(RodAngles s, double time, double step) const {
    const double count = std::ceil(time / step), h = time / count;
    for (double i = 0; i < count; ++i) {
        const RodAngles k1 = change(s), k2 = change(sum(s, k1, h / 2)),
                        k3 = change(sum(s, k2, h / 2)), k4 = change(sum(s, k3, h));
        s = sum(sum(sum(sum(s, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
    }
    return s;
}

double TwoRods::energy(const RodAngles& s) const {
    const double square = length * length, w0 = s.rate[0], w1 = s.rate[1];
    const double moving = 0.5 * (inertia + 1.25 * square) * w0 * w0 +
                          0.5 * (inertia + 0.25 * square) * w1 * w1 +
                          0.5 * square * std::cos(s.angle[0] - s.angle[1]) * w0 * w1;
    return moving - gravity * length * (1.5 * std::cos(s.angle[0]) + 0.5 * std::cos(s.angle[1]));
}

}  // namespace plumb::study
