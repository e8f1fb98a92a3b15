// SPDX-License-Identifier: MIT
/// Symplectic Euler with the gyroscopic term in three forms (§3).
///
/// The paper's explicit form gains energy; the implicit one loses some; the conserving one carries
/// the angular momentum from step to step and turns with the rate of the step's middle
/// (math/free_rotation.h). With a leapfrog start the very first push is half of one: velocities are
/// then those in the middle of substeps, for which the same formulas are of second order.
#include "kernels/body_columns.h"
#include "kernels/contact_kernels.h"
#include "math/matrices.h"
#include "step/stages.h"

#include <Eigen/LU>

namespace plumb {
namespace {

/// One Newton step of ω₁ = ω₀ − h I⁻¹(ω₁ × I ω₁), in the body frame.
Vector3d implicit_rate(const Vector3d& w0, const Vector3d& inertia, double h) {
    const Vector3d l = inertia.cwiseProduct(w0);
    const Matrix3d i = inertia.asDiagonal();
    const Matrix3d jacobian = i + h * (skew(w0) * i - skew(l));
    return w0 - jacobian.partialPivLu().solve(h * w0.cross(l));
}

Vector3d explicit_rate(const Vector3d& w0, const Vector3d& inertia, double h) {
    return w0 - h * w0.cross(inertia.cwiseProduct(w0)).cwiseQuotient(inertia);
}

void add_gyroscopic_term(Bodies& b, const std::vector<std::uint32_t>& bodies, Gyroscopic form,
                         double h) {
    for (const std::uint32_t i : bodies) {
        if (b.isotropic[i]) continue;
        const Quaterniond& q = b.orientation[i];
        const Vector3d w = q.conjugate() * b.angular_velocity[i];
        b.angular_velocity[i] =
            q * (form == Gyroscopic::implicit ? implicit_rate(w, b.inertia[i], h)
                                              : explicit_rate(w, b.inertia[i], h));
    }
}

BodyList list_of(const std::vector<std::uint32_t>& bodies) {
    return {bodies.data(), bodies.size()};
}

const BodyKernels& kernels_for(const Settings& s) {
    return body_kernels(s.lanes == 0 ? widest_lanes() : static_cast<int>(s.lanes));
}

}  // namespace

void integrate_velocities(World& world, const Plan& plan, const MotionLists& lists,
                          const SubstepTime& time, double fall) {
    const BodyKernels& kernels = kernels_for(world.settings);
    const BodyColumns columns = columns_of(world.bodies);
    const double h = time.h, push = time.push();
    const Vector3d g = world.settings.gravity * (fall / push);
    const double gravity[3] = {g.x(), g.y(), g.z()};
    kernels.integrate(columns, list_of(lists.plain), gravity, h, push);
    kernels.integrate_gyroscopic(columns, list_of(lists.gyroscopic), gravity, h, push);
    if (plan.runs(Effect::gyroscopic) && world.settings.gyroscopic != Gyroscopic::conserving)
        add_gyroscopic_term(world.bodies, lists.plain, world.settings.gyroscopic, h);
}

void move(World& world, const MotionLists& lists, double h) {
    const BodyKernels& kernels = kernels_for(world.settings);
    const BodyColumns columns = columns_of(world.bodies);
    kernels.move(columns, list_of(lists.plain), h);
    kernels.move(columns, list_of(lists.scripted), h);
    kernels.move_gyroscopic(columns, list_of(lists.gyroscopic), h);
}

}  // namespace plumb
