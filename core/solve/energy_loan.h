// SPDX-License-Identifier: MIT
/// How much kinetic energy joints and contacts may give to bodies that joints hold together.
///
/// Bodies move along chords of their swings, and have a little more energy in one substep and a
/// little less in another. What an island gains beyond the work of its drives is therefore a loan,
/// of a small share of its energy: it counts until as much has been lost again, and while it
/// counts so much less is lent. So however long an island is hit, or stays unsolved, it never has
/// more than that share above what it had at any time before. Where it would, only a share of all
/// that is changed of its velocities is taken, and joints close later. Where that would open them
/// by much, what is solved exactly is braked by little instead (islands/island_loan.h). Either
/// keeps the sums of momentum.
///
/// Gravity counts by its work on the mean of the velocities at the start and at the end of the
/// substep, as leapfrog has it.
#pragma once

#include "solve/gaping_joints.h"
#include "ties/driven_axes.h"
#include "ties/tie_work.h"
#include "world/body_momentum.h"
#include "world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

/// Of two bodies, as far as they are dynamic [kg].
inline double moving_mass(const World& world, std::uint32_t a, std::uint32_t b) {
    double mass = 0;
    for (const std::uint32_t body : {a, b})
        if (body != kNoIndex && world.bodies.motion[body] == Motion::dynamic)
            mass += world.bodies.mass[body];
    return mass;
}

/// The energy of two bodies at the speed at which what is off by so much closes [J]; `off`: [m].
inline double closing_energy(const World& world, std::uint32_t a, std::uint32_t b, double off,
                             double h) {
    const double speed = std::min(off / h, world.settings.recovery_speed);
    return 0.5 * moving_mass(world, a, b) * speed * speed;
}

/// How far a joint is open or past a limit, at the rims of its bodies [m].
inline double opening_of(const World& world, std::uint32_t index) {
    const Bodies& b = world.bodies;
    const Joint& joint = world.joints.joints[index];
    double along = joint_gap(b, joint), about = joint_turn_gap(b, joint), radius = 0;
    each_driven_axis(world.joints, index, [&](std::uint32_t first, std::uint32_t last) {
        const JointPose pose = joint_pose(b, joint);
        for (std::uint32_t i = first; i < last; ++i) {
            const JointError error = limit_error(world, world.joints.drives[i], pose);
            along = std::max(along, error.along), about = std::max(about, error.about);
        }
    });
    for (const std::uint32_t body : {joint.a, joint.b})
        if (body != kNoIndex && b.motion[body] == Motion::dynamic)
            radius = std::max(radius, b.bounding_radius[body]);
    return std::max(along, about * radius);
}

struct EnergyLoan {
    /// The share of its kinetic energy that is lent to an island.
    static constexpr double kLent = 0.01;

    double moving = 0;   ///< kinetic energy before the changes [J]
    double linear = 0;   ///< with a share s of the changes it gains
    double square = 0;   ///< linear s + square s² [J]
    double granted = 0;  ///< the most that its drives give [J]
    double closing = 0;  ///< energy at the speeds at which old errors close [J]
    double braking = 0;  ///< with a share s of its velocities against rest it loses
    double braked = 0;   ///< braking s − braked s² [J]
    double owed = 0;     ///< of loans before [J]
    /// Velocity of who sees the energies: what a script moves so does no work [m/s].
    Vector3d frame = Vector3d::Zero();

    /// The greatest share of all changes with which it gains no more than it may.
    double share() const {
        if (linear + square <= most()) return 1;
        if (!std::isfinite(linear) || !(square > 0)) return 0;
        const double root = std::sqrt(linear * linear + 4 * square * most());
        return std::clamp((root - linear) / (2 * square), 0.0, 1.0);
    }

    /// The least share of its velocities against rest without which it gains no more than it may,
    /// with all changes.
    double brake() const {
        const double excess = linear + square - most();
        if (excess <= 0) return 0;
        const double root = std::sqrt(braking * braking - 4 * braked * excess);
        constexpr double none = std::numeric_limits<double>::infinity();
        return root >= 0 && braked > 0 ? (braking - root) / (2 * braked) : none;
    }

    /// What it gains with a share of all changes, and with all of them once it is braked [J].
    double gained_with(double share) const {
        return share > 0 ? (linear + square * share) * share : 0;
    }
    double gained_braked(double share) const {
        return linear + square - (braking - braked * share) * share;
    }

    /// What is owed once so much is gained [J].
    double owed_after(double gained) const {
        return std::max(0.0, owed + (gained > 0 ? std::max(0.0, gained - granted) : gained));
    }

    /// What a body gains whose velocities change by (dv, dw), from v and w on [m/s], [rad/s].
    void add_change(const Bodies& b, std::uint32_t i, const Vector3d& v, const Vector3d& w,
                    const Vector3d& dv, const Vector3d& dw) {
        const Vector3d middle = 0.5 * (b.velocity_now[i] + v) - frame;
        moving += kinetic_energy(b, i, v - frame, w);
        linear += b.mass[i] * middle.dot(dv) + inertia_product(b, i, w, dw);
        square += kinetic_energy(b, i, dv, dw);
    }
    /// What it may lose of its velocities after that, which are (u, r) against rest.
    void add_braking(const Bodies& b, std::uint32_t i, const Vector3d& v, const Vector3d& w,
                     const Vector3d& dv, const Vector3d& dw, const Velocity<double>& against_rest) {
        const Vector3d &u = against_rest.v, &r = against_rest.w;
        const Vector3d middle = 0.5 * (b.velocity_now[i] + v) - frame;
        braking += b.mass[i] * (middle + dv).dot(u) + inertia_product(b, i, w + dw, r);
        braked += kinetic_energy(b, i, u, r);
    }
    /// What overlaps by so much [m] may part, and is lifted by it.
    void add_overlap(const World& world, const Contact& c, double overlap, double h) {
        const double off = std::max(0.0, overlap);
        closing += closing_energy(world, c.a, c.b, off, h) +
                   moving_mass(world, c.a, c.b) * world.settings.gravity.norm() * off;
    }
    /// What a joint owes, and what it may give by closing and by what drives it.
    void add_joint(const World& world, std::uint32_t index, double h) {
        const Joint& joint = world.joints.joints[index];
        owed += joint.owed;
        granted += most_work(world, index, h);
        closing += closing_energy(world, joint.a, joint.b, opening_of(world, index), h);
    }

private:
    double most() const {
        return std::max({0.0, granted + kLent * moving - owed, granted + closing - moving});
    }
};

}  // namespace plumb
