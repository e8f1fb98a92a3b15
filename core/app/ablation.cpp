// SPDX-License-Identifier: MIT
#include "app/ablation.h"

#include "app/interrupt.h"
#include "app/statistics.h"
#include "host/log.h"
#include "measure/measure.h"
#include "study/trajectory.h"

#include <exception>
#include <memory>

namespace plumb::app {
namespace {

/// A run and the times of its steps.
class Trial {
public:
    explicit Trial(std::unique_ptr<Simulation> simulation) : simulation_(std::move(simulation)) {}

    void step(std::vector<double>& times_ms) {
        finite_ = simulation_->step().finite;
        times_ms.push_back(static_cast<double>(simulation_->ledger().step_nanoseconds) * 1e-6);
    }
    bool finite() const { return finite_; }
    const World& world() const { return simulation_->world(); }
    std::uint64_t steps() const { return simulation_->steps(); }

private:
    std::unique_ptr<Simulation> simulation_;
    bool finite_ = true;
};

std::string divergence(const Trial& with, const Trial& without) {
    if (!with.finite())
        return "the run itself is no longer finite after step " + std::to_string(with.steps());
    return "without it the run is no longer finite after step " + std::to_string(without.steps());
}

/// One repeat: steps in turn, each run first in every other one.
void run_pair(AblatedEffect& result, std::vector<double>& with_ms, std::vector<double>& without_ms,
              Trial& with, Trial& without, std::uint64_t steps) {
    for (std::uint64_t i = 0; i < steps && with.finite() && without.finite(); ++i) {
        if (i % 2 == 0) with.step(with_ms);
        without.step(without_ms);
        if (i % 2 == 1) with.step(with_ms);
        if (interrupted()) return;
    }
    result.compared = with.finite() && without.finite();
    if (!result.compared) {
        result.trouble = divergence(with, without);
        return;
    }
    const study::Moment a = study::moment_of(with.world()), b = study::moment_of(without.world());
    result.error = largest_distance(a, b);
    result.energy_change = b.energy - a.energy;
}

AblatedEffect without(const std::string& name, const Scene& scene, const ColliderLibrary& colliders,
                      const RunOptions& options, const AblationPlan& plan) {
    AblatedEffect result;
    result.name = name;
    Scene less = scene;
    less.settings.forbid.push_back(name);
    std::vector<double> with_ms, without_ms;
    try {
        for (std::uint32_t i = 0; i < plan.repeats && !interrupted(); ++i) {
            Trial with(start(scene, colliders, options)), lacking(start(less, colliders, options));
            run_pair(result, with_ms, without_ms, with, lacking, plan.steps);
        }
    } catch (const std::exception& e) {
        result.trouble = std::string("cannot be left out: ") + e.what();
    }
    result.timed = !with_ms.empty() && !without_ms.empty();
    if (!result.timed) return result;
    result.with_ms = percentile(with_ms, 0.5);
    result.without_ms = percentile(without_ms, 0.5);
    return result;
}

}  // namespace

std::vector<AblatedEffect> ablate(const Scene& scene, const ColliderLibrary& colliders,
                                  const RunOptions& options, const Simulation& simulation,
                                  const AblationPlan& plan) {
    // both runs of a pair are on the collider that was chosen once
    RunOptions same = options;
    same.collider = simulation.collider_name();
    const ErrorsOnly quiet;  // each lack is on purpose
    std::vector<AblatedEffect> effects;
    for (const Decision& d : simulation.plan().decisions)
        if (d.runs && !interrupted())
            effects.push_back(without(std::string(d.name), scene, colliders, same, plan));
    return effects;
}

}  // namespace plumb::app
