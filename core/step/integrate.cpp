// SPDX-License-Identifier: MIT
/// Symplectic Euler with the gyroscopic term in three forms (§3).
///
/// The paper's explicit form gains energy; the implicit one loses some; the conserving one carries
/// the angular momentum L from step to step and turns with the rate of the step's middle, ω_m = R_m
/// I⁻¹ R_mᵀ L with R_m = exp(h ω_m / 2) R, found by a few fixed-point rounds.
#include "math/rotation.h"
#include "step/stages.h"

#include <cmath>

namespace plumb {
namespace {

Symmetric3<double> world_inverse_inertia(const Bodies& b, std::size_t i) {
    return rotated_diagonal(b.orientation[i].toRotationMatrix(), b.inverse_inertia[i]);
}

/// I ω and I⁻¹ L in the world frame.
Vector3d momentum_of(const Quaterniond& q, const Vector3d& inertia, const Vector3d& w) {
    return q * inertia.cwiseProduct(q.conjugate() * w);
}

/// Rate of rotation in the middle of the step.
Vector3d middle_rate(const Bodies& b, std::size_t i, const Vector3d& momentum, double h) {
    Vector3d w = momentum_of(b.orientation[i], b.inverse_inertia[i], momentum);
    for (int round = 0; round < 12; ++round) {
        const Quaterniond middle = turned(b.orientation[i], 0.5 * h * w);
        const Vector3d next = momentum_of(middle, b.inverse_inertia[i], momentum);
        const double change = (next - w).squaredNorm();
        w = next;
        if (change <= 1e-26 * w.squaredNorm()) break;
    }
    return w;
}

/// One Newton step of ω₁ = ω₀ − h I⁻¹(ω₁ × I ω₁), in the body frame.
Vector3d implicit_rate(const Vector3d& w0, const Vector3d& inertia, double h) {
    const Vector3d l = inertia.cwiseProduct(w0);
    auto skew = [](const Vector3d& v) {
        Matrix3d m;
        m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
        return m;
    };
    const Matrix3d i = inertia.asDiagonal();
    const Matrix3d jacobian = i + h * (skew(w0) * i - skew(l));
    return w0 - jacobian.partialPivLu().solve(h * w0.cross(l));
}

void integrate_rotation(Bodies& b, std::size_t i, Gyroscopic form, double h) {
    const Quaterniond& q = b.orientation[i];
    Vector3d& w = b.angular_velocity[i];
    if (form == Gyroscopic::conserving) {
        b.angular_momentum[i] = momentum_of(q, b.inertia[i], w) + h * b.torque[i];
        w = middle_rate(b, i, b.angular_momentum[i], h);
        return;
    }
    w += h * momentum_of(q, b.inverse_inertia[i], b.torque[i]);
    const Vector3d w_body = q.conjugate() * w;
    if (form == Gyroscopic::implicit) {
        w = q * implicit_rate(w_body, b.inertia[i], h);
    } else {
        const Vector3d l = b.inertia[i].cwiseProduct(w_body);
        w = q * (w_body - h * b.inverse_inertia[i].cwiseProduct(w_body.cross(l)));
    }
}

}  // namespace

void integrate_velocities(World& world, const Plan& plan, double h) {
    Bodies& b = world.bodies;
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (b.motion[i] != Motion::dynamic) continue;
        b.world_inverse_inertia[i] = world_inverse_inertia(b, i);
        b.velocity[i] += h * (world.settings.gravity + b.inverse_mass[i] * b.force[i]);
        if (!b.isotropic[i] && plan.runs(Effect::gyroscopic))
            integrate_rotation(b, i, world.settings.gyroscopic, h);
        else
            b.angular_velocity[i] += h * (b.world_inverse_inertia[i] * b.torque[i]);
    }
}

void move(World& world, const RowSolver& solver, double h) {
    Bodies& b = world.bodies;
    const bool carries_momentum = world.settings.gyroscopic == Gyroscopic::conserving;
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (b.motion[i] == Motion::fixed) continue;
        const Quaterniond before = b.orientation[i];
        Vector3d turn_change = Vector3d::Zero();
        if (b.motion[i] == Motion::dynamic) {
            turn_change = solver.angular_velocity_change(b.row[i]);
            b.velocity[i] += solver.velocity_change(b.row[i]);
            b.angular_velocity[i] += turn_change;
        }
        b.position[i] += h * b.velocity[i];
        b.orientation[i] = turned(before, h * b.angular_velocity[i]);
        if (b.isotropic[i] || !carries_momentum) continue;
        b.angular_momentum[i] += momentum_of(before, b.inertia[i], turn_change);
        b.angular_velocity[i] =
            momentum_of(b.orientation[i], b.inverse_inertia[i], b.angular_momentum[i]);
    }
}

}  // namespace plumb
