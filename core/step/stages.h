// SPDX-License-Identifier: MIT
/// The stages of a step that work on the world's tables, but for those of contacts
/// (contacts/contact_stages.h). Each does one thing; step.cpp puts them in order.
#pragma once

#include "constraints/spring.h"
#include "effects/plan.h"
#include "effects/report.h"
#include "schedule/motion_lists.h"
#include "world/world.h"

#include <plumb/proximity.h>

#include <vector>

namespace plumb {

/// Kinematic bodies' velocities over the coming substep of length h [s], from their scripts.
void move_scripted(World& world, double h);

/// Where the plan does not run kinematics, kinematic bodies stand still.
void hold_scripted(Bodies& bodies);

/// Keeps the velocities of this substep and of the one before, by which the levers of joints turn
/// and collisions are found.
void remember_velocities(Bodies& bodies);
/// Those of some.
void remember_velocities(Bodies& bodies, const std::vector<std::uint32_t>& some);

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

/// Joints that break under some load, by index.
std::vector<std::uint32_t> breakable_joints(const World& world);

/// Breaks those of the joints whose load was more than they bear; bodies that nothing keeps apart
/// any more may touch from the next step on.
void break_joints(World& world, const std::vector<std::uint32_t>& breakable, const Plan& plan,
                  Proximity& proximity, StepReport& report);

/// Counts the links that the step left too long or too short.
void note_stretched_links(const World& world, StepReport& report);

/// Takes elements that are strained too far out of their deformables. The stepper is then of the
/// world before.
void tear(World& world, StepReport& report);

}  // namespace plumb
