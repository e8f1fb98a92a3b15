// SPDX-License-Identifier: MIT
/// The free rotation of a body with three different moments of inertia
/// (Landau, Lifshitz: Mechanics, §37).
///
/// In the frame of the body, for L² > 2 E I₂ and τ = ν t + τ₀,
///
///   ω = (A cn τ, B sn τ, C dn τ),   ν² = (I₃ − I₂)(L² − 2 E I₁) / (I₁ I₂ I₃),
///   k² = (I₂ − I₁)(2 E I₃ − L²) / ((I₃ − I₂)(L² − 2 E I₁))
#pragma once

#include "math/types.h"
#include "study/elliptic.h"

#include <cmath>

namespace plumb::study {

class FreeTop {
public:
    /// `inertia`: I₁ < I₂ < I₃ [kg m²], of any common scale; `start`: ω at time 0 [rad/s], none of
    /// it negative.
    FreeTop(const Vector3d& inertia, const Vector3d& start) {
        const double i1 = inertia[0], i2 = inertia[1], i3 = inertia[2];
        const Vector3d momentum = inertia.cwiseProduct(start);
        const double square = momentum.squaredNorm(), energy = momentum.dot(start);  // L², 2 E
        const double below = energy * i3 - square, above = square - energy * i1;
        most_ = {std::sqrt(below / (i1 * (i3 - i1))), std::sqrt(below / (i2 * (i3 - i2))),
                 std::sqrt(above / (i3 * (i3 - i1)))};
        rate_ = std::sqrt((i3 - i2) * above / (i1 * i2 * i3));
        modulus_ = std::sqrt((i2 - i1) * below / ((i3 - i2) * above));
        start_ = argument(start);
    }

    /// ω at a time [rad/s], body frame.
    Vector3d angular_velocity(double time) const {
        const Elliptic e = jacobi(start_ + rate_ * time, modulus_);
        return most_.cwiseProduct(Vector3d(e.cn, e.sn, e.dn));
    }

    /// How far a body that turns at ω at a time is ahead of the motion [s].
    double ahead(const Vector3d& angular_velocity, double time) const {
        const double off = argument(angular_velocity) - (start_ + rate_ * time);
        return std::remainder(off, 4 * std::comp_ellint_1(modulus_)) / rate_;
    }

    /// Time between two flips, at which ω₂ changes its sign [s].
    double flip_interval() const { return 2 * std::comp_ellint_1(modulus_) / rate_; }

private:
    /// τ, whose amplitude am τ has the tangent sn τ / cn τ.
    double argument(const Vector3d& w) const {
        return std::ellint_1(modulus_, std::atan2(w[1] / most_[1], w[0] / most_[0]));
    }

    Vector3d most_;  ///< A, B, C [rad/s]
    double rate_, modulus_, start_;
};

}  // namespace plumb::study
