// SPDX-License-Identifier: MIT
/// Contact, friction, rolling and spinning friction as one set (§6): the impulses and torques that
/// a contact can bear, and the nearest of them to any other.
///
///   n x y    impulse along the normal and two tangents [N s]
///   p q r    torque about the same axes over a length ℓ [N s], so that all six have one unit
///   μ        coefficient of friction
///   σ ρ      levers of spinning and of rolling friction over ℓ
///   the cone |(x, y)| ≤ μ n,  |p| ≤ σ n,  |(q, r)| ≤ ρ n,  0 ≤ n ≤ N
///   N        more than a contact bears that can be satisfied: too narrow a gap pushes no harder
///
/// The law of contact, for velocities u (those about the axes times ℓ) that shall be w and any mass
/// m > 0, is: λ = nearest point of the cone to λ + m (w̃ − u), where w̃ is w less μ |u_xy − w_xy| and
/// its like along the normal (de Saxcé): without that shift what slides would have to lift.
#pragma once

#include "math/types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace plumb {

/// All six numbers of a contact, or the first three where nothing resists its turning.
template <int N>
using ContactVector = Eigen::Matrix<double, N, 1>;

/// How many parts of them the normal impulse bounds.
template <int N>
inline constexpr int kBoundParts = N == 3 ? 1 : 3;

struct ContactCone {
    double friction, spinning, rolling;  ///< μ, σ, ρ
    double most;                         ///< N

    bool turns() const { return spinning > 0 || rolling > 0; }
};

/// A point of the cone, and which of its parts are at their bounds.
template <int N>
struct ConePoint {
    ContactVector<N> impulse = ContactVector<N>::Zero();
    bool pushes = false, slides = false, spins = false, rolls = false;
    bool strained = false;  ///< n = N

    bool inside() const { return pushes && !slides && !spins && !rolls && !strained; }
};

/// Lengths of the parts of z that the normal impulse bounds.
template <class Vector, int N = Vector::SizeAtCompileTime>
inline std::array<double, kBoundParts<N>> cone_lengths(const Vector& z) {
    const double across = std::sqrt(z[1] * z[1] + z[2] * z[2]);
    if constexpr (N == 3)
        return {across};
    else
        return {across, std::abs(z[3]), std::sqrt(z[4] * z[4] + z[5] * z[5])};
}

/// What each of these may be of the normal impulse.
template <int N>
inline std::array<double, kBoundParts<N>> levers_of(const ContactCone& c) {
    if constexpr (N == 3)
        return {c.friction};
    else
        return {c.friction, c.spinning, c.rolling};
}

/// The nearest point of the cone to z. Where parts of z are too long, its n is the root of a
/// function that rises, is made of straight pieces and bends down: Newton's method from below ends
/// on the root after as many steps as there are parts.
template <class Vector, int N = Vector::SizeAtCompileTime>
inline ConePoint<N> nearest_on_cone(const Vector& z, const ContactCone& c) {
    constexpr int kParts = kBoundParts<N>;
    const std::array<double, kParts> length = cone_lengths(z), lever = levers_of<N>(c);
    double n = 0;
    std::array<bool, kParts> at_bound{};
    for (int round = 0; round <= kParts; ++round) {
        double sum = z[0], weight = 1;
        bool same = round > 0;
        for (int i = 0; i < kParts; ++i) {
            const bool beyond = length[i] > lever[i] * n;
            same &= beyond == at_bound[i];
            at_bound[i] = beyond;
            if (beyond) sum += lever[i] * length[i], weight += lever[i] * lever[i];
        }
        if (same) break;
        n = sum / weight;
        if (!(n > 0)) return {};
    }
    ConePoint<N> point;
    point.impulse = z;
    point.pushes = true;
    point.strained = n > c.most;
    if (point.strained) {
        n = c.most;
        for (int i = 0; i < kParts; ++i) at_bound[i] = length[i] > lever[i] * n;
    }
    point.impulse[0] = n;
    point.slides = at_bound[0];
    if (at_bound[0]) point.impulse.template segment<2>(1) *= lever[0] * n / length[0];
    if constexpr (N == 6) {
        point.spins = at_bound[1], point.rolls = at_bound[2];
        if (at_bound[1]) point.impulse[3] *= lever[1] * n / length[1];
        if (at_bound[2]) point.impulse.template segment<2>(4) *= lever[2] * n / length[2];
    }
    return point;
}

/// ∂(nearest point)/∂z: symmetric, between 0 and 1. What is at a bound moves along one common ray
/// with the normal, and around its own circle by how far it has come in.
template <class Vector, int N = Vector::SizeAtCompileTime>
inline Eigen::Matrix<double, N, N> cone_derivative(const Vector& z, const ConePoint<N>& at,
                                                   const ContactCone& c) {
    using Matrix = Eigen::Matrix<double, N, N>;
    if (!at.pushes) return Matrix::Zero();
    const auto length = cone_lengths(z);
    Matrix d = Matrix::Zero();
    ContactVector<N> ray = ContactVector<N>::Zero();
    ray[0] = 1;
    const auto disc = [&](int first, bool bound, double lever, double size) {
        if (!bound) {
            d(first, first) = d(first + 1, first + 1) = 1;
            return;
        }
        const double x = z[first] / size, y = z[first + 1] / size;
        const double around = lever * at.impulse[0] / size;
        ray[first] = lever * x, ray[first + 1] = lever * y;
        d(first, first) = around * y * y;
        d(first + 1, first + 1) = around * x * x;
        d(first, first + 1) = d(first + 1, first) = -around * x * y;
    };
    disc(1, at.slides, c.friction, length[0]);
    if constexpr (N == 6) {
        disc(4, at.rolls, c.rolling, length[2]);
        if (at.spins)
            ray[3] = c.spinning * (z[3] < 0 ? -1 : 1);
        else
            d(3, 3) = 1;
    }
    if (at.strained) return d;
    return d + ray * ray.transpose() / ray.squaredNorm();
}

/// The impulse that the law of contact asks for after one step of mass m along what the velocity
/// lacks: first the normal, then the rest within its bounds. It equals `impulse` where the law
/// holds.
template <class Vector, int N = Vector::SizeAtCompileTime>
inline ContactVector<N> lawful_step(const Vector& impulse,
                                    const std::type_identity_t<ContactVector<N>>& lack, double mass,
                                    const ContactCone& c) {
    ContactVector<N> z = impulse + mass * lack;
    z[0] = std::clamp(z[0], 0.0, c.most);
    const auto length = cone_lengths(z);
    const auto share = [&](double lever, double size) {
        const double most = lever * z[0];
        return size > most ? most / size : 1;
    };
    z.template segment<2>(1) *= share(c.friction, length[0]);
    if constexpr (N == 6) {
        z[3] *= share(c.spinning, length[1]);
        z.template segment<2>(4) *= share(c.rolling, length[2]);
    }
    return z;
}

/// Velocities by which the parts of an impulse that are at their bounds slip, each times its lever.
template <class Vector, int N = Vector::SizeAtCompileTime>
inline double slipping(const Vector& impulse, const std::array<double, kBoundParts<N>>& speed,
                       const ContactCone& c) {
    const auto held = cone_lengths(impulse), lever = levers_of<N>(c);
    double sum = 0;
    for (int i = 0; i < kBoundParts<N>; ++i)
        if (held[i] >= (1 - 1e-6) * lever[i] * impulse[0]) sum += lever[i] * speed[i];
    return sum;
}

/// What slip, u − w of parts at their bounds, takes from the wanted normal velocity (de Saxcé).
/// Slip below `slack` does not count: then what stands is the solution of a convex problem, which
/// is found whenever there is one, and what slides lifts by less than μ times that.
template <class Vector, int N = Vector::SizeAtCompileTime>
inline double slip_shift(const Vector& impulse, const ContactVector<N>& slip, double slack,
                         const ContactCone& c) {
    auto fast = cone_lengths(slip);
    for (double& x : fast) x = std::max(0.0, x - slack);
    return slipping(impulse, fast, c);
}

}  // namespace plumb
