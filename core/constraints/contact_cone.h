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

namespace plumb {

struct ContactCone {
    double friction, spinning, rolling;  ///< μ, σ, ρ
    double most;                         ///< N

    bool turns() const { return spinning > 0 || rolling > 0; }
};

/// A point of the cone, and which of its parts are at their bounds.
struct ConePoint {
    Vector6d impulse;
    bool pushes, slides, spins, rolls;
    bool strained;  ///< n = N

    bool inside() const { return pushes && !slides && !spins && !rolls && !strained; }
};

/// Lengths of the three parts of z that the normal impulse bounds.
inline std::array<double, 3> cone_lengths(const Vector6d& z) {
    return {std::sqrt(z[1] * z[1] + z[2] * z[2]), std::abs(z[3]),
            std::sqrt(z[4] * z[4] + z[5] * z[5])};
}

/// The nearest point of the cone to z. Where parts of z are too long, its n is the root of a
/// function that rises, is made of straight pieces and bends down: Newton's method from below ends
/// on the root after as many steps as there are parts.
inline ConePoint nearest_on_cone(const Vector6d& z, const ContactCone& c) {
    const std::array<double, 3> length = cone_lengths(z), lever{c.friction, c.spinning, c.rolling};
    double n = 0;
    std::array<bool, 3> at_bound{};
    for (int round = 0; round < 4; ++round) {
        double sum = z[0], weight = 1;
        bool same = round > 0;
        for (int i = 0; i < 3; ++i) {
            const bool beyond = length[i] > lever[i] * n;
            same &= beyond == at_bound[i];
            at_bound[i] = beyond;
            if (beyond) sum += lever[i] * length[i], weight += lever[i] * lever[i];
        }
        if (same) break;
        n = sum / weight;
        if (!(n > 0)) return {Vector6d::Zero(), false, false, false, false, false};
    }
    const bool strained = n > c.most;
    if (strained) {
        n = c.most;
        for (int i = 0; i < 3; ++i) at_bound[i] = length[i] > lever[i] * n;
    }
    ConePoint point{z, true, at_bound[0], at_bound[1], at_bound[2], strained};
    point.impulse[0] = n;
    if (at_bound[0]) point.impulse.segment<2>(1) *= lever[0] * n / length[0];
    if (at_bound[1]) point.impulse[3] *= lever[1] * n / length[1];
    if (at_bound[2]) point.impulse.segment<2>(4) *= lever[2] * n / length[2];
    return point;
}

/// ∂(nearest point)/∂z: symmetric, between 0 and 1. What is at a bound moves along one common ray
/// with the normal, and around its own circle by how far it has come in.
inline Matrix6d cone_derivative(const Vector6d& z, const ConePoint& at, const ContactCone& c) {
    if (!at.pushes) return Matrix6d::Zero();
    const std::array<double, 3> length = cone_lengths(z);
    Matrix6d d = Matrix6d::Zero();
    Vector6d ray = Vector6d::Zero();
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
    disc(4, at.rolls, c.rolling, length[2]);
    if (at.spins)
        ray[3] = c.spinning * (z[3] < 0 ? -1 : 1);
    else
        d(3, 3) = 1;
    if (at.strained) return d;
    return d + ray * ray.transpose() / ray.squaredNorm();
}

/// The impulse that the law of contact asks for after one step of mass m along what the velocity
/// lacks: first the normal, then the rest within its bounds. It equals `impulse` where the law
/// holds.
inline Vector6d lawful_step(const Vector6d& impulse, const Vector6d& lack, double mass,
                            const ContactCone& c) {
    Vector6d z = impulse + mass * lack;
    z[0] = std::clamp(z[0], 0.0, c.most);
    const std::array<double, 3> length = cone_lengths(z);
    const auto share = [&](double lever, double size) {
        const double most = lever * z[0];
        return size > most ? most / size : 1;
    };
    z.segment<2>(1) *= share(c.friction, length[0]);
    z[3] *= share(c.spinning, length[1]);
    z.segment<2>(4) *= share(c.rolling, length[2]);
    return z;
}

/// Velocities by which the parts of an impulse that are at their bounds slip, each times its lever.
inline double slipping(const Vector6d& impulse, const std::array<double, 3>& speed,
                       const ContactCone& c) {
    const std::array<double, 3> held = cone_lengths(impulse),
                                lever{c.friction, c.spinning, c.rolling};
    double sum = 0;
    for (int i = 0; i < 3; ++i)
        if (held[i] >= (1 - 1e-6) * lever[i] * impulse[0]) sum += lever[i] * speed[i];
    return sum;
}

/// What slip, u − w of parts at their bounds, takes from the wanted normal velocity (de Saxcé).
/// Slip below `slack` does not count: then what stands is the solution of a convex problem, which
/// is found whenever there is one, and what slides lifts by less than μ times that.
inline double slip_shift(const Vector6d& impulse, const Vector6d& slip, double slack,
                         const ContactCone& c) {
    std::array<double, 3> fast = cone_lengths(slip);
    for (double& x : fast) x = std::max(0.0, x - slack);
    return slipping(impulse, fast, c);
}

}  // namespace plumb
