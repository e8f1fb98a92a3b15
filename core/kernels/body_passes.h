// SPDX-License-Identifier: MIT
/// The loops behind the bodies' kernels (§3). Included by the units of each instruction set and by
/// nothing else.
#pragma once

#include "kernels/body_kernels.h"
#include "kernels/item_group.h"
#include "math/free_rotation.h"
#include "math/symmetric.h"

namespace plumb::kernels {

/// v ← v + h (g + F/m), and I⁻¹ in the world's frame. Returns it.
template <int W, class T = Number<double, W>>
inline Symmetric3<T> integrate_travel(const BodyColumns& b, const ItemGroup<W>& group,
                                      const UnitQuaternion<T>& q, const double (&gravity)[3],
                                      double h) {
    Vector3<T> axes[3];
    q.columns(axes);
    const Symmetric3<T> inverse = rotated_diagonal<T>(axes, group.vector(b.inverse_inertia));
    const Vector3<T> g = Vector3<T>(T(gravity[0]), T(gravity[1]), T(gravity[2]));
    const Vector3<T> rate = g + group.vector(b.force) * group.number(b.inverse_mass);
    group.write(b.world_inverse_inertia, inverse);
    group.write(b.velocity, Vector3<T>(group.vector(b.velocity) + rate * T(h)));
    return inverse;
}

template <int W>
[[gnu::flatten]] void integrate(const BodyColumns& b, BodyList list, const double (&gravity)[3],
                                double h) {
    using T = Number<double, W>;
    for (std::size_t i = 0; i < list.count; i += W) {
        const ItemGroup<W> group(list, i);
        const Symmetric3<T> inverse =
            integrate_travel<W>(b, group, group.rotation(b.orientation), gravity, h);
        const Vector3<T> w = group.vector(b.angular_velocity);
        group.write(b.angular_velocity,
                    Vector3<T>(w + Vector3<T>(inverse * group.vector(b.torque)) * T(h)));
    }
}

template <int W>
[[gnu::flatten]] void integrate_turning(const BodyColumns& b, BodyList list,
                                        const double (&gravity)[3], double h) {
    using T = Number<double, W>;
    for (std::size_t i = 0; i < list.count; i += W) {
        const ItemGroup<W> group(list, i);
        const UnitQuaternion<T> q = group.rotation(b.orientation);
        integrate_travel<W>(b, group, q, gravity, h);
        const Vector3<T> inertia = group.vector(b.inertia);
        const Vector3<T> rate = q.inverse() * group.vector(b.angular_velocity);
        const Vector3<T> pushed = q.inverse() * Vector3<T>(group.vector(b.torque) * T(h));
        const Vector3<T> momentum = inertia.cwiseProduct(rate) + pushed;
        group.write(b.angular_momentum, q * momentum);
        group.write(b.angular_velocity,
                    q * middle_rate<T>(momentum, inertia, group.vector(b.inverse_inertia), T(h)));
    }
}

/// x ← x + h v, q ← exp(h ω) q. Returns q before and after.
template <int W, class T = Number<double, W>>
struct Moved {
    UnitQuaternion<T> before, after;
    Vector3<T> rate;

    Moved(const BodyColumns& b, const ItemGroup<W>& group, double h)
        : before(group.rotation(b.orientation)) {
        const Vector3<T> x = group.vector(b.position), v = group.vector(b.velocity);
        rate = group.vector(b.angular_velocity);
        after = (unit_exponential<T>(Vector3<T>(rate * T(h))) * before).normalized();
        group.write(b.position, Vector3<T>(x + v * T(h)));
        group.write(b.orientation, after);
    }
};

template <int W>
[[gnu::flatten]] void move(const BodyColumns& b, BodyList list, double h) {
    for (std::size_t i = 0; i < list.count; i += W) Moved<W>(b, ItemGroup<W>(list, i), h);
}

template <int W>
[[gnu::flatten]] void move_turning(const BodyColumns& b, BodyList list, double h) {
    using T = Number<double, W>;
    for (std::size_t i = 0; i < list.count; i += W) {
        const ItemGroup<W> group(list, i);
        const Moved<W> q(b, group, h);
        const Vector3<T> inertia = group.vector(b.inertia);
        const Vector3<T> change = q.before.inverse() * group.vector(b.turn_change);
        const Vector3<T> momentum =
            group.vector(b.angular_momentum) + q.before * Vector3<T>(inertia.cwiseProduct(change));
        const Vector3<T> inverse = group.vector(b.inverse_inertia);
        const Vector3<T> after = q.after.inverse() * momentum;
        const T too_far = turns_too_far<T>(q.rate, T(h));
        T kept = T(1);
        if (any_greater(too_far, T(0)))
            kept = select_greater(
                too_far, T(0), energy_correction<T>(q.before.inverse() * momentum, after, inverse),
                kept);
        group.write(b.angular_momentum, momentum * kept);
        group.write(b.angular_velocity, q.after * Vector3<T>(inverse.cwiseProduct(after) * kept));
    }
}

template <int W>
constexpr BodyKernels all_body_kernels() {
    return {integrate<W>, integrate_turning<W>, move<W>, move_turning<W>};
}

}  // namespace plumb::kernels
