// SPDX-License-Identifier: MIT
/// The stages of a step that work on the world's tables. Each does one thing; step.cpp puts them in
/// order.
#pragma once

#include "constraints/spring.h"
#include "effects/ledger.h"
#include "effects/plan.h"
#include "effects/report.h"
#include "schedule/motion_lists.h"
#include "schedule/workers.h"
#include "step/contact_room.h"
#include "world/world.h"

#include <plumb/proximity.h>

#include <vector>

namespace plumb {

/// Reused memory of detection.
struct DetectBuffers {
    std::vector<Pose> poses;
    std::vector<double> sweeps;
    std::vector<ContactRoom> rooms;  ///< [worker], behind the sinks
    std::vector<ContactSink> sinks;  ///< [worker]
    std::vector<Vec3> places;        ///< of particles
};

/// Asks the collider for all contacts at the present poses, bodies growing their margin by how far
/// they may move in dt [s]; pairs that hardly moved keep their contacts. Its status and message go
/// into the report; only the time inside its call counts as detection.
void detect(World& world, const Plan& plan, Workers& workers, Proximity& proximity,
            DetectBuffers& buffers, double dt, StepReport& report, Ledger& ledger);

/// The solver's workers, for the collider.
TaskRunner runner_on(Workers& workers);

/// Asks the collider for the contacts of particles at the poses of `detect`, checks and sorts them.
void detect_particles(World& world, Workers& workers, Proximity& proximity, DetectBuffers& buffers,
                      double dt, StepReport& report, Ledger& ledger);

/// Checks and sorts what was found, and hands each contact the memory of the same contact of the
/// step before.
void match_contacts(World& world, const Plan& plan);

/// Gaps, common points and anchor slips at the start of a substep, from points that ride on the
/// bodies.
void follow_contacts(World& world, const Plan& plan, bool first_substep);

/// Kinematic bodies' velocities over the coming substep of length h [s], from their scripts.
void move_scripted(World& world, double h);

/// Where the plan does not run kinematics, kinematic bodies stand still.
void hold_scripted(Bodies& bodies);

/// Keeps the velocities of this substep and of the one before, by which the levers of joints turn
/// and collisions are found.
void remember_velocities(Bodies& bodies);
/// Those of some.
void remember_velocities(Bodies& bodies, const std::vector<std::uint32_t>& some);

/// Which contacts bounce in this substep, and how fast (§6: collision or contact, after Mirtich).
/// Speeds are those before forces are added, so that a resting body does not bounce, whatever its
/// e.
void choose_restitution(World& world, bool first_substep);

/// v ← v + f g + p F/m, ω ← ω + p I⁻¹ τ − h I⁻¹ (ω × Iω) (§3); and I⁻¹ in the world's frame.
/// p = time.push(), f = `fall`: for how long forces push and gravity does [s], in most substeps h.
void integrate_velocities(World& world, const Plan& plan, const MotionLists& lists,
                          const SubstepTime& time, double fall);

/// x ← x + h v, q ← exp(h ω) q with the velocities that the passes have made; where angular
/// momentum is carried, it decides the velocity that is left.
void move(World& world, const MotionLists& lists, double h);

/// The same of particles, which do not turn.
void integrate_particles(World& world, double h);
void move_particles(World& world, double h);

/// Breaks the joints whose load was more than they bear; bodies that nothing keeps apart any more
/// may touch from the next step on.
void break_joints(World& world, const Plan& plan, Proximity& proximity, StepReport& report);

/// Takes elements that are strained too far out of their deformables. The stepper is then of the
/// world before.
void tear(World& world, StepReport& report);

/// Keeps contacts and impulses for the next step.
void remember_contacts(World& world);

}  // namespace plumb
