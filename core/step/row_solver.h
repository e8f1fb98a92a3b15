// SPDX-License-Identifier: MIT
/// The iterations of a substep, in one precision and lane width chosen at run time.
///
/// A virtual call is one stage over all constraints, never one constraint. Where it takes a ledger,
/// the caller times its stage around it, and the shares of joints and trees are booked apart.
#pragma once

#include "contacts/contact_sums.h"
#include "effects/ledger.h"
#include "effects/plan.h"
#include "effects/report.h"
#include "schedule/workers.h"
#include "world/world.h"

#include <memory>
#include <vector>

namespace plumb {

class RowSolver {
public:
    virtual ~RowSolver() = default;

    /// Once a step: takes the contacts, with the impulses that they remember.
    virtual void load(const World& world) = 0;

    /// Once a substep of length h [s]: velocities, gaps and anchor slip at its start. Returns how
    /// many contacts overlap deeper than the substep may push out.
    virtual std::uint32_t begin_substep(const World& world, double h, Ledger& ledger) = 0;

    /// Collisions that begin in this substep, before forces: contacts/impacts.h. Adds what they
    /// bear to the sums, if there are any.
    virtual void solve_impacts(World& world, double h, ContactSums* sums) = 0;

    virtual void solve_velocities() = 0;
    /// Tells the report of what could not be solved.
    virtual void solve_positions(const World& world, StepReport& report, Ledger& ledger) = 0;
    /// Where the iterations above added energy: step/energy_bound.h.
    virtual void bound_energy(const World& world, double h) = 0;
    /// The same of joints: step/joint_energy_bound.h.
    virtual void bound_joint_energy(World& world, double h) = 0;
    /// Islands that are solved exactly (islands/island_group.h); the same.
    virtual void solve_islands(const World& world, StepReport& report) = 0;
    virtual void propagate_shock() = 0;
    /// After all of these: adds what contacts bear in this substep, besides its impacts.
    virtual void add_impulses(ContactSums& sums) = 0;

    /// Adds what the passes changed to the velocities of dynamic bodies and particles, and keeps
    /// the turns'.
    virtual void take_changes(World& world) const = 0;

    /// After the last substep: how far its end is from its constraints.
    virtual StepResidual find_residual(const World& world) = 0;
    /// The same of each island.
    virtual const std::vector<IslandResidual>& island_residuals() const = 0;

    /// Whether all joints are in trees that were solved in the last substep, and nothing else acted
    /// on bodies.
    virtual bool has_undisturbed_trees() const = 0;

    /// Once a substep and once a step, after the move: impulses, into the world's tables.
    virtual void end_substep(World& world, Ledger& ledger) = 0;
    virtual void end_step(World& world) = 0;
};

/// How many constraints are solved side by side: Settings::lanes, or else as many as the processor
/// runs and the world is likely to fill, for wide lanes that stand empty only cost time.
int lanes_of(const World& world);

/// Throws SceneError when this processor cannot run Settings::lanes.
std::unique_ptr<RowSolver> make_row_solver(const World& world, const Plan& plan, Workers& workers);

}  // namespace plumb
