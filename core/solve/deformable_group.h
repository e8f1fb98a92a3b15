// SPDX-License-Identifier: MIT
/// All that holds deformables together: the constraints of each formula, and volumes.
#pragma once

#include "solve/joined_bodies.h"
#include "solve/momentum_keeper.h"
#include "solve/point_group.h"
#include "solve/volume_group.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace plumb {

template <class Real, int W>
class DeformableGroup final : public ConstraintGroup<Real> {
public:
    DeformableGroup(const World& world, Workers& workers)
        : workers_(workers),
          bodies_(world, world.settings.multilevel),
          keeper_(world, bodies_.mass(), workers),
          volumes_(world, bodies_.mass(), workers) {
        add(Formulas(), world, workers);
    }

    Stage stage() const override { return Stage::particles; }
    bool empty() const override { return groups_.empty() && volumes_.empty(); }

    std::uint32_t rounds() const override {
        std::uint32_t most = 1;
        for (const auto& group : groups_) most = std::max(most, group->rounds());
        return most;
    }

    void begin(const World& world, const BodyRows<Real>& rows, const PassSettings<Real>& pass,
               double h) override {
        h_ = h;
        bodies_.begin(world);
        keeper_.begin(world);
        for (const auto& group : groups_) group->begin(world, rows, pass, h);
    }

    void iterate_positions(const BodyRows<Real>& rows, const PassSettings<Real>& pass,
                           std::uint32_t worker) override {
        // each substep iterates alike, or what the iterations leave would swing from one to the
        // next
        PassSettings<Real> mine = pass;
        mine.forwards = pass.iteration % 2 == 0;
        if (worker == 0) bodies_.note(rows);
        keeper_.note(rows, worker);
        for (const auto& group : groups_) group->iterate_positions(rows, mine, worker);
        if (!volumes_.empty())
            volumes_.iterate(rows, h_, pass.iteration == 0 && pass.round == 0, worker);
        keeper_.restore(rows, worker);
        if (bodies_.empty()) return;
        if (worker == 0) bodies_.give(rows);
        workers_.barrier();
    }

    /// Those that share in what deforms.
    const JoinedBodies<Real>& bodies() const { return bodies_; }

private:
    template <class... F>
    void add(FormulaList<F...>, const World& world, Workers& workers) {
        (add_formula<F>(world, workers), ...);
    }
    template <class F>
    void add_formula(const World& world, Workers& workers) {
        auto group = std::make_unique<PointGroup<F, Real, W>>(world, bodies_.mass(), workers);
        if (!group->empty()) groups_.push_back(std::move(group));
    }

    Workers& workers_;
    JoinedBodies<Real> bodies_;
    MomentumKeeper<Real> keeper_;
    std::vector<std::unique_ptr<ConstraintGroup<Real>>> groups_;
    VolumeGroup<Real> volumes_;
    double h_ = 0;
};

}  // namespace plumb
