// SPDX-License-Identifier: MIT
#include "study/free_run.h"

#include "host/log.h"
#include "host/source_proximity.h"
#include "measure/within_reach.h"
#include "scene/error.h"
#include "study/trajectory.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumb::study {
namespace {

constexpr std::uint64_t kSamples = 200;
constexpr int kFailuresInARow = 10;

/// The runs, in step with each other.
struct Run {
    std::string collider;
    std::unique_ptr<SourceProximity> remote;
    std::unique_ptr<Simulation> simulation;
    int failures = 0;  ///< in a row
};

std::vector<Run> start_runs(const Scene& scene, const ColliderLibrary& colliders,
                            const std::vector<std::unique_ptr<ContactSource>>& sources,
                            const std::vector<bool>& own_process) {
    std::vector<Run> runs(sources.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
        Run& run = runs[i];
        run.collider = sources[i]->info().name;
        if (!own_process[i]) {
            run.simulation = std::make_unique<Simulation>(scene, colliders, run.collider);
            continue;
        }
        run.remote = std::make_unique<SourceProximity>(*sources[i]);
        run.simulation = std::make_unique<Simulation>(scene, *run.remote, run.collider);
    }
    return runs;
}

/// One step; false where the state is of no use any more.
bool advance(Run& run, std::uint32_t& contacts) {
    const StepReport report = run.simulation->step();
    contacts = report.contacts;
    run.failures = report.collider_failed ? run.failures + 1 : 0;
    if (run.failures >= kFailuresInARow)
        throw ColliderError("collider \"" + run.collider + "\" failed " +
                            std::to_string(kFailuresInARow) + " steps in a row of its free run (" +
                            report.message + ")");
    return report.finite && within_reach(run.simulation->world());
}

void add_drift(Drift& drift, const Moment& first, const Moment& second) {
    const std::vector<double> apart = distances(first, second);
    const double sum = std::accumulate(apart.begin(), apart.end(), 0.0);
    drift.mean.push_back(apart.empty() ? 0 : sum / static_cast<double>(apart.size()));
    drift.largest.push_back(largest_distance(first, second));
}

void take_sample(FreeRuns& result, const std::vector<Run>& runs) {
    result.times.push_back(runs.front().simulation->time());
    std::vector<Moment> moments;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        moments.push_back(moment_of(runs[i].simulation->world()));
        result.height[i].push_back(moments[i].height);
        result.energy[i].push_back(moments[i].energy);
    }
    for (Drift& drift : result.drifts)
        add_drift(drift, moments[drift.first], moments[drift.second]);
}

}  // namespace

FreeRuns free_runs(const Scene& scene, const ColliderLibrary& colliders,
                   const std::vector<std::unique_ptr<ContactSource>>& sources,
                   const std::vector<bool>& own_process, const FreeRunWatch& watch) {
    const ErrorsOnly quiet;  // the driver's run has told all
    std::vector<Run> runs = start_runs(scene, colliders, sources, own_process);
    FreeRuns result;
    result.height.resize(runs.size());
    result.energy.resize(runs.size());
    result.diverged_after.resize(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (std::size_t j = i + 1; j < runs.size(); ++j) result.drifts.push_back({i, j, {}, {}});

    const Settings& s = scene.settings;
    const std::uint64_t steps = step_count(s);
    const std::uint64_t every = std::max<std::uint64_t>(1, steps / kSamples);
    take_sample(result, runs);
    for (std::uint64_t i = 1; i <= steps && !result.was_interrupted; ++i) {
        bool finite = true;
        std::uint32_t contacts = 0;
        for (std::size_t k = 0; k < runs.size(); ++k) {
            if (advance(runs[k], contacts)) continue;
            finite = false;
            result.diverged_after[k] = i;
        }
        if (!finite) break;
        result.was_interrupted = watch && !watch(i, contacts);
        if (i % every == 0 || i == steps || result.was_interrupted) take_sample(result, runs);
    }
    return result;
}

}  // namespace plumb::study
