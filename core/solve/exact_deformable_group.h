// SPDX-License-Identifier: MIT
/// All that holds deformables together, solved as one system. Contacts, links and attachments stay
/// with the iterations, in turn with it.
#pragma once

#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "solve/elastic_system.h"
#include "solve/momentum_keeper.h"
#include "solve/particle_rows.h"

#include <vector>

namespace plumb {

template <class Real>
class ExactDeformableGroup final : public ConstraintGroup<Real> {
public:
    ExactDeformableGroup(const World& world, Workers& workers)
        : workers_(workers),
          system_(world),
          mass_(world.particles),
          keeper_(world, mass_, workers) {
        velocity_.resize(world.particles.size());
        before_.resize(velocity_.size());
    }

    Stage stage() const override { return Stage::particles; }
    bool empty() const override { return velocity_.empty(); }

    void load(const World& world) override { system_.load(world); }

    void begin(const World& world, const BodyRows<Real>&, const PassSettings<Real>&,
               double h) override {
        first_row_ = world.particle_row(0);
        keeper_.begin(world);
        system_.begin(world, h);
    }

    void iterate_positions(const BodyRows<Real>& rows, const PassSettings<Real>&,
                           std::uint32_t worker) override {
        keeper_.note(rows, worker);
        if (worker == 0) solve(rows);
        workers_.barrier();
        keeper_.restore(rows, worker);
    }

    void end_step(World& world) override { system_.store(world.particles); }

private:
    void solve(const BodyRows<Real>& rows) {
        for (std::size_t i = 0; i < velocity_.size(); ++i)
            before_[i] = velocity_[i] = velocity_of(rows, row(i)).v;
        system_.solve(velocity_);
        for (std::size_t i = 0; i < velocity_.size(); ++i)
            add_change(rows, row(i), Vector3d(velocity_[i] - before_[i]));
    }

    std::int32_t row(std::size_t particle) const {
        return first_row_ + static_cast<std::int32_t>(particle);
    }

    Workers& workers_;
    ElasticSystem system_;
    ParticleMass mass_;
    MomentumKeeper<Real> keeper_;
    std::vector<Vector3d> velocity_, before_;  ///< [particle] [m/s]
    std::int32_t first_row_ = 0;
};

}  // namespace plumb
