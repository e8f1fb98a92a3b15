// SPDX-License-Identifier: MIT
/// All constraints of one kind, as the step sees them.
///
/// A virtual call is one stage over a whole group, never one constraint. Groups are solved in the
/// order in which the row solver lists them, each by all workers together; what comes later has the
/// last word.
#pragma once

#include "effects/ledger.h"
#include "effects/report.h"
#include "schedule/contact_rows.h"
#include "solve/island_residuals.h"
#include "world/world.h"

namespace plumb {

template <class Real>
class ConstraintGroup {
public:
    virtual ~ConstraintGroup() = default;

    /// On which its time is booked.
    virtual Stage stage() const = 0;
    /// Nothing to solve in this step.
    virtual bool empty() const = 0;

    /// Once a step, after contacts were found.
    virtual void load(const World&) {}

    /// Once a substep of length h [s]: arms, errors and masses at its start.
    virtual void begin(const World& world, const BodyRows<Real>& rows,
                       const PassSettings<Real>& pass, double h) = 0;

    /// Applies the impulses of the substep before, where the group keeps them.
    virtual void warm_start(const BodyRows<Real>&, const PassSettings<Real>&) {}

    /// One iteration of the velocity or the position pass, called by every worker; ends with all of
    /// them at a barrier.
    virtual void iterate_velocities(const BodyRows<Real>&, const PassSettings<Real>&,
                                    std::uint32_t /*worker*/) {}
    virtual void iterate_positions(const BodyRows<Real>&, const PassSettings<Real>&,
                                   std::uint32_t /*worker*/) {}

    /// Once a substep and once a step, after the move: impulses, into the world's tables.
    virtual void end_substep(World&) {}
    virtual void end_step(World&) {}

    /// How many rounds an iteration of the position pass calls for.
    virtual std::uint32_t rounds() const { return 1; }

    /// After the last substep's iterations: whether it tells how far its constraints are from being
    /// solved. If some do, all name the bodies of theirs that no tie holds, and tell what they can.
    virtual bool has_residuals() const { return false; }
    virtual void add_rows(std::vector<BodyPair>&) const {}
    virtual void add_residuals(IslandResiduals&, const World&, const BodyRows<Real>&,
                               const PassSettings<Real>&) {}

    /// What could not be solved.
    virtual void report(StepReport&) const {}
};

}  // namespace plumb
