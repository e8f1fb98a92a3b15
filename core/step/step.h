// SPDX-License-Identifier: MIT
/// The time step.
#pragma once

#include "contacts/contact_stages.h"
#include "contacts/contact_sums.h"
#include "contacts/ghost_contacts.h"
#include "contacts/still_ground.h"
#include "contacts/surface_detector.h"
#include "effects/ledger.h"
#include "effects/plan.h"
#include "effects/report.h"
#include "schedule/workers.h"
#include "step/air.h"
#include "step/divided_trees.h"
#include "step/fast_joints.h"
#include "step/row_solver.h"
#include "step/sleeping.h"
#include "step/stages.h"
#include "step/whirled_trees.h"
#include "ties/joint_state.h"
#include "world/world.h"

#include <plumb/proximity.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace plumb {

/// What steps need besides the world: the plan, the threads, and reused memory.
struct Stepper {
    explicit Stepper(const World& world)
        : plan(make_plan(world)),
          workers(world.settings.threads),
          motion(sort_by_motion(world, plan.runs(Effect::gyroscopic))),
          revolute(revolute_joints(world)),
          breakable(breakable_joints(world)),
          surfaces(world),
          air(plan.runs(Effect::air_drag) ? Air(world) : Air()),
          divided(plan.runs(Effect::divided_trees) ? DividedTrees(world, plan) : DividedTrees()),
          fast_joints(world, plan),
          whirled(world, plan),
          solver(make_row_solver(world, plan, workers)) {}

    /// After a change of the world that calls for other effects, or of its joints, rows or elements
    /// of deformables. What a step leaves for the next is in the world's tables, so that nothing is
    /// lost. A solver without joints, deformables and links holds nothing of the world, and its
    /// memory serves on.
    void renew(const World& world) {
        const Plan before = std::exchange(plan, make_plan(world));
        revolute = revolute_joints(world);
        breakable = breakable_joints(world);
        if (plan.runs(Effect::surface_contacts)) surfaces = SurfaceDetector(world);
        if (plan.runs(Effect::air_drag)) air = Air(world);
        renew_rows(world, !plan.runs_as(before));
    }

    /// The same where only the rows of bodies changed. `anew`: the solver is of another plan.
    void renew_rows(const World& world, bool anew = false) {
        motion = sort_by_motion(world, plan.runs(Effect::gyroscopic));
        if (plan.runs(Effect::divided_trees)) divided = DividedTrees(world, plan);
        fast_joints = FastJoints(world, plan);
        whirled = WhirledTrees(world, plan);
        const bool holds =
            plan.runs(Effect::joints) || plan.runs(Effect::deformables) || plan.runs(Effect::links);
        if (holds || anew) solver = make_row_solver(world, plan, workers);
    }

    Plan plan;
    Workers workers;
    MotionLists motion;
    std::vector<std::uint32_t> revolute;   ///< joints whose turns are counted
    std::vector<std::uint32_t> breakable;  ///< joints that bear no more than so much
    SurfaceDetector surfaces;
    Air air;
    DividedTrees divided;
    FastJoints fast_joints;
    WhirledTrees whirled;
    std::unique_ptr<RowSolver> solver;
    DetectBuffers buffers;
    GhostContacts ghosts;
    GroundTouch ground;
    StillGround still_ground;
    Sleeping sleeping;
    std::optional<ContactSums> sums;  ///< of the last step, where someone wants them
    Ledger ledger;                    ///< of the last step
};

/// Advances the world by Settings::dt. Where StepReport::torn_elements is not 0, the stepper must
/// be renewed before the next step.
StepReport step(World& world, Stepper& stepper, Proximity& proximity);

}  // namespace plumb
