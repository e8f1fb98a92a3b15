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
                                      double push) {
    Vector3<T> axes[3];
    q.columns(axes);
    const Symmetric3<T> inverse = rotated_diagonal<T>(axes, group.vector(b.inverse_inertia));
    const Vector3<T> g = Vector3<T>(T(gravity[0]), T(gravity[1]), T(gravity[2]));
    const Vector3<T> rate = g + group.vector(b.force) * group.number(b.inverse_mass);
    group.write(b.world_inverse_inertia, inverse);
    group.write(b.velocity, Vector3<T>(group.vector(b.velocity) + rate * T(push)));
    return inverse;
}

template <int W>
[[gnu::flatten]] void integrate(const BodyColumns& b, BodyList list, const double (&gravity)[3],
                                double, double push) {
    using T = Number<double, W>;
    for (std::size_t i = 0; i < list.count; i += W) {
        const ItemGroup<W> group(list, i);
        const Symmetric3<T> inverse =
            integrate_travel<W>(b, group, group.rotation(b.orientation), gravity, push);
        const Vector3<T> w = group.vector(b.angular_velocity);
        group.write(b.angular_velocity,
                    Vector3<T>(w + Vector3<T>(inverse * group.vector(b.torque)) * T(push)));
    }
}

template <int W>
[[gnu::flatten]] void integrate_gyroscopic(const BodyColumns& b, BodyList list,
                                           const double (&gravity)[3], double h, double push) {
    using T = Number<double, W>;
    for (std::size_t i = 0; i < list.count; i += W) {
        const ItemGroup<W> group(list, i);
        const UnitQuaternion<T> q = group.rotation(b.orientation);
        integrate_travel<W>(b, group, q, gravity, push);
        const Vector3<T> inertia = group.vector(b.inertia);
        const Vector3<T> rate = q.inverse() * group.vector(b.angular_velocity);
        const Vector3<T> pushed = q.inverse() * Vector3<T>(group.vector(b.torque) * T(push));
        const Vector3<T> momentum = inertia.cwiseProduct(rate) + pushed;
        group.write(b.angular_momentum, q * momentum);
        group.write(b.angular_velocity,
                    q * middle_rate<T>(momentum, inertia, group.vector(b.inverse_inertia), T(h)));
    }
}

/// x ← x + h v.
template <int W>
inline void travel(const BodyColumns& b, const ItemGroup<W>& group, double h) {
    using T = Number<double, W>;
    const Vector3<T> x = group.vector(b.position), v = group.vector(b.velocity);
    group.write(b.position, Vector3<T>(x + v * T(h)));
}

/// exp(h ω) q.
template <int W, class T = Number<double, W>>
inline UnitQuaternion<T> turned(const BodyColumns& b, const ItemGroup<W>& group,
                                const UnitQuaternion<T>& q, double h) {
    const Vector3<T> rate = group.vector(b.angular_velocity);
    return (unit_exponential<T>(Vector3<T>(rate * T(h))) * q).normalized();
}

template <int W>
[[gnu::flatten]] void move(const BodyColumns& b, BodyList list, double h) {
    using T = Number<double, W>;
    for (std::size_t i = 0; i < list.count; i += W) {
        const ItemGroup<W> group(list, i);
        const UnitQuaternion<T> q = group.rotation(b.orientation);
        travel<W>(b, group, h);
        group.write(b.orientation, turned<W>(b, group, q, h));
    }
}

/// 1 where a body turns by itself: nothing changed its rate, or it turns too far for what did to
/// have been right about the pose at the end. Else 0.
template <class T>
inline T turns_freely(const Vector3<T>& change, const Vector3<T>& rate, const T& h) {
    const T unmoved = select_greater(dot(change, change), T(0), T(0), T(1));
    return max(unmoved, turns_too_far<T>(rate, h));
}

/// As `move`; L ← L + R I Rᵀ Δω decides the rate that is left. Δω is what the passes changed.
template <int W>
[[gnu::flatten]] void move_gyroscopic(const BodyColumns& b, BodyList list, double h) {
    using T = Number<double, W>;
    for (std::size_t i = 0; i < list.count; i += W) {
        const ItemGroup<W> group(list, i);
        const UnitQuaternion<T> q = group.rotation(b.orientation);
        const Vector3<T> inverse = group.vector(b.inverse_inertia);
        const Vector3<T> change = group.vector(b.turn_change);
        const Vector3<T> pushed =
            group.vector(b.inertia).cwiseProduct(Vector3<T>(q.inverse() * change));
        const Vector3<T> momentum = group.vector(b.angular_momentum) + q * pushed;
        UnitQuaternion<T> after = turned<W>(b, group, q, h);
        const T is_free = turns_freely<T>(change, group.vector(b.angular_velocity), T(h));
        if (any_greater(is_free, T(0))) {
            Vector3<T> l = q.inverse() * momentum;
            const UnitQuaternion<T> alone = (q * free_turn<T>(l, inverse, T(h))).normalized();
            for (int k = 0; k < 3; ++k)
                after.v[k] = select_greater(is_free, T(0), alone.v[k], after.v[k]);
            after.w = select_greater(is_free, T(0), alone.w, after.w);
        }
        travel<W>(b, group, h);
        group.write(b.orientation, after);
        group.write(b.angular_momentum, momentum);
        group.write(
            b.angular_velocity,
            after * Vector3<T>(inverse.cwiseProduct(Vector3<T>(after.inverse() * momentum))));
    }
}

template <int W>
constexpr BodyKernels all_body_kernels() {
    return {integrate<W>, integrate_gyroscopic<W>, move<W>, move_gyroscopic<W>};
}

}  // namespace plumb::kernels
