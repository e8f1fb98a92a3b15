// SPDX-License-Identifier: MIT
#include "app/free_run.h"

#include "app/interrupt.h"
#include "app/within_reach.h"
#include "host/source_proximity.h"
#include "measure/measure.h"
#include "scene/error.h"

#include <algorithm>
#include <cmath>

namespace plumb::app {
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

/// Mean height of the dynamic bodies, against gravity [m].
double mean_height(const World& world) {
    const Vector3d& g = world.settings.gravity;
    const Vector3d up = g.norm() > 0 ? Vector3d(-g.normalized()) : Vector3d(Vector3d::UnitY());
    double sum = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        if (world.bodies.motion[i] == Motion::dynamic) sum += up.dot(world.bodies.position[i]);
    return sum / std::max(1, world.dynamic_count);
}

void add_drift(Drift& drift, const Bodies& first, const Bodies& second) {
    double sum = 0, largest = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (first.motion[i] != Motion::dynamic) continue;
        const double distance = (first.position[i] - second.position[i]).norm();
        sum += distance, ++count;
        largest = std::max(largest, distance);
    }
    drift.mean.push_back(count > 0 ? sum / static_cast<double>(count) : 0);
    drift.largest.push_back(largest);
}

void take_sample(FreeRuns& result, const std::vector<Run>& runs) {
    result.times.push_back(runs.front().simulation->time());
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const World& world = runs[i].simulation->world();
        result.height[i].push_back(mean_height(world));
        result.energy[i].push_back(kinetic_energy(world) + potential_energy(world));
    }
    for (Drift& drift : result.drifts)
        add_drift(drift, runs[drift.first].simulation->world().bodies,
                  runs[drift.second].simulation->world().bodies);
}

}  // namespace

FreeRuns free_runs(const Scene& scene, const ColliderLibrary& colliders,
                   const std::vector<std::unique_ptr<ContactSource>>& sources,
                   const std::vector<bool>& own_process, Progress& progress) {
    std::vector<Run> runs = start_runs(scene, colliders, sources, own_process);
    FreeRuns result;
    result.height.resize(runs.size());
    result.energy.resize(runs.size());
    result.diverged_after.resize(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (std::size_t j = i + 1; j < runs.size(); ++j) result.drifts.push_back({i, j, {}, {}});

    const Settings& s = scene.settings;
    const auto steps = static_cast<std::uint64_t>(std::llround(s.duration / s.dt));
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
        result.was_interrupted = interrupted();
        if (i % every == 0 || i == steps || result.was_interrupted) take_sample(result, runs);
        progress.show(i, contacts, "free runs");
    }
    return result;
}

}  // namespace plumb::app
