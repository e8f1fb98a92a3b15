// SPDX-License-Identifier: MIT
#include "study/run_point.h"

#include "host/log.h"
#include "host/simulation.h"
#include "measure/within_reach.h"
#include "scene/error.h"
#include "study/sweep_plan.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>

namespace plumb::study {
namespace {

/// Farther than this from the origin, or faster, nothing of use happens any more [m], [m/s],
/// [rad/s].
constexpr double kReach = 1e9;

std::vector<std::unique_ptr<Judge>> judges_of(const Subject& subject) {
    std::vector<std::unique_ptr<Judge>> judges;
    for (const Metric& m : subject.metrics) judges.push_back(m.judge());
    return judges;
}

/// A run that takes less is made a second time for its cost: what the first takes to warm the
/// caches is not what its settings cost [µs].
constexpr double kShort = 2000;

/// The share of a stretch of time in which this process ran: the rest went to others.
class RunningShare {
public:
    double so_far() const {
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
        const double cpu = static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC;
        return wall.count() > 0 ? std::min(cpu / wall.count(), 1.0) : 1;
    }

private:
    std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
    std::clock_t cpu_ = std::clock();
};

Outcome ended(Status status, std::string note) { return {status, std::move(note), {}, {}}; }

Outcome made(const Subject& subject, Simulation& simulation, bool judged, const Stop& stop) {
    const Settings& s = simulation.world().settings;
    const std::uint64_t steps = step_count(s);
    std::vector<std::unique_ptr<Judge>> judges;
    if (judged) judges = judges_of(subject);
    std::uint64_t total = 0, solver = 0;
    const RunningShare running;
    const auto cost = [&](double simulated) -> Cost {
        const double per_second = simulated > 0 ? 1e-3 * running.so_far() / simulated : 0;
        return {static_cast<double>(total) * per_second, static_cast<double>(solver) * per_second};
    };
    const auto diverged = [&](std::string note, double simulated) -> Outcome {
        return {Status::diverged, std::move(note), {}, cost(simulated)};
    };
    for (const auto& judge : judges) judge->look(simulation.world());
    for (std::uint64_t i = 0; i < steps; ++i) {
        if (stop && stop()) return ended(Status::not_run, "time was up");
        const StepReport report = simulation.step();
        total += simulation.ledger().step_nanoseconds;
        solver += simulation.ledger().solver_nanoseconds();
        if (!report.finite || !within_reach(simulation.world(), kReach))
            return diverged("ran off after " + std::to_string(simulation.time()) + " s",
                            simulation.time());
        if (report.collider_unusable) return ended(Status::refused, report.message);
        for (const auto& judge : judges) judge->look(simulation.world());
    }
    Outcome outcome{Status::done, {}, {}, {}};
    for (const auto& judge : judges) {
        outcome.errors.push_back(judge->error());
        if (!std::isfinite(judge->error()))
            return diverged("the error is no number", simulation.time());
    }
    outcome.cost = cost(simulation.time());
    return outcome;
}

}  // namespace

Outcome run_point(const Subject& subject, const Point& point, const ColliderLibrary& colliders,
                  bool judged, const Stop& stop) {
    try {
        Scene scene = subject.scene;
        scene.settings = settings_at(subject, point);
        const ErrorsOnly quiet;
        const auto run = [&](bool with_errors) {
            Simulation simulation(scene, colliders, point.collider);
            return made(subject, simulation, with_errors, stop);
        };
        Outcome outcome = run(judged);
        if (outcome.status == Status::done &&
            outcome.cost.total * scene.settings.duration < kShort) {
            const Outcome warm = run(false);
            if (warm.status == Status::done) outcome.cost = warm.cost;
        }
        return outcome;
    } catch (const SceneError& e) {
        return ended(Status::refused, e.what());
    } catch (const ColliderError& e) {
        return ended(Status::refused, e.what());
    }
}

}  // namespace plumb::study
