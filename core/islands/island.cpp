// SPDX-License-Identifier: MIT
#include "islands/island.h"

namespace plumb {
namespace {

/// A bound on the greatest eigenvalue: the greatest sum of a row.
double largest(const Symmetric3<double>& k) {
    const double xy = std::abs(k.xy), xz = std::abs(k.xz), yz = std::abs(k.yz);
    return std::max({k.xx + xy + xz, k.yy + xy + yz, k.zz + xz + yz});
}

}  // namespace

void find_masses(IslandPoint& p, const InverseMass<double>& of_a, const InverseMass<double>& of_b) {
    p.mass = 1 / largest(point_response(of_a, p.arm_a) + point_response(of_b, p.arm_b));
    p.length = std::sqrt(1 / (largest(of_a.inertia + of_b.inertia) * p.mass));
    const Vector3d normal = p.frame.col(0);
    Velocity<double> a{Vector3d::Zero(), Vector3d::Zero()}, b = a;
    apply_impulse<double>(a, of_a, p.arm_a, normal);
    apply_impulse<double>(b, of_b, p.arm_b, -normal);
    const Vector3d along = velocity_at<double>(a, p.arm_a) - velocity_at<double>(b, p.arm_b);
    p.answer << p.frame.transpose() * along, p.length * (p.frame.transpose() * (a.w - b.w));
    p.mass_normal = 1 / p.answer[0];
}

}  // namespace plumb
