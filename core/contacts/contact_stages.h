// SPDX-License-Identifier: MIT
/// The stages of a step that find contacts, follow them and keep them. Each does one thing;
/// step/step.cpp puts them in order.
///
/// In: the world's poses and a collider. Out: ContactTable and ParticleContactTable, which the
/// solver reads.
#pragma once

#include "contacts/contact_room.h"
#include "contacts/reuse_contacts.h"
#include "effects/ledger.h"
#include "effects/plan.h"
#include "effects/report.h"
#include "schedule/workers.h"
#include "world/joined_points.h"
#include "world/world.h"

#include <plumb/proximity.h>

#include <vector>

namespace plumb {

/// Reused memory of detection.
struct DetectBuffers {
    std::vector<BodyMotion> motions;  ///< [body]
    std::vector<double> sweeps;       ///< [body] BodyMotion::sweep, as colliders take it [m]
    std::vector<ContactRoom> rooms;   ///< [worker], behind the sinks
    std::vector<ContactSink> sinks;   ///< [worker]
    std::vector<Vec3> places;         ///< of particles
    JoinedPoints joined;
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

/// Hands each contact that was detected the memory of the same contact of the step before, and puts
/// it among those that were kept.
void match_contacts(World& world, const Plan& plan, Workers& workers);

/// Gaps, common points and anchor slips at the start of a substep, from points that ride on the
/// bodies.
void follow_contacts(World& world, const Plan& plan, Workers& workers, bool first_substep);

/// Which contacts bounce in this substep, and how fast (§6: collision or contact, after Mirtich).
/// Speeds are those before forces are added, so that a resting body does not bounce, whatever its
/// e.
void choose_restitution(World& world, bool first_substep);

}  // namespace plumb
