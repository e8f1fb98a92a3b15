// SPDX-License-Identifier: MIT
/// An engine on Plumb's cases of known accuracy: error against CPU time, as CSV.
#include "accuracy/peer.h"
#include "measure/within_reach.h"
#include "study/cases.h"
#include "ties/joint_state.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace plumb::bench {
namespace {

using Clock = std::chrono::steady_clock;  // as on Plumb's ledger
constexpr int kRuns = 3;
constexpr double kReach = 1e9;  // farther off or faster, a body has run away [m], [m/s], [rad/s]

struct Result {
    std::vector<double> errors;  ///< [metric]
    double cost = 0;             ///< of steps [µs per simulated second]
    const char* status = "done";
};

/// Forces are not read back from the engines.
bool is_judged(const study::Metric& metric) { return metric.name != "force"; }

/// One run. `limit`: how long it may take [s].
Result run(const study::Subject& subject, const Engine& engine, const Fineness& fineness,
           bool judged, double limit) {
    World world = build_world(subject.scene);
    world.settings.dt = fineness.dt;
    const auto revolute = revolute_joints(world);
    const auto peer = engine.make(subject.scene, world, fineness);
    std::vector<std::unique_ptr<study::Judge>> judges;
    for (const study::Metric& metric : subject.metrics)
        if (judged && is_judged(metric)) judges.push_back(metric.judge());
    for (const auto& judge : judges) judge->look(world);

    Result result;
    const auto steps = std::llround(world.settings.duration / fineness.dt);
    const auto begin = Clock::now();
    Clock::duration total{};
    for (long long i = 0; i < steps; ++i) {
        const auto start = Clock::now();
        peer->step();
        const auto end = Clock::now();
        total += end - start;
        if (std::chrono::duration<double>(end - begin).count() > limit) return {{}, 0, "slow"};
        if (!judged) continue;
        peer->read(world);
        world.time = static_cast<double>(++world.steps) * fineness.dt;
        if (!within_reach(world, kReach)) return {{}, 0, "diverged"};
        count_turns(world, revolute);
        for (const auto& judge : judges) judge->look(world);
    }
    for (const auto& judge : judges) {
        result.errors.push_back(judge->error());
        if (!std::isfinite(judge->error())) result.status = "diverged";
    }
    result.cost = std::chrono::duration<double, std::micro>(total).count() /
                  (static_cast<double>(steps) * fineness.dt);
    return result;
}

Result run_or_diverge(const study::Subject& subject, const Engine& engine, const Fineness& fineness,
                      bool judged, double limit) {
    try {
        return run(subject, engine, fineness, judged, limit);
    } catch (const EngineFailure&) {
        return {{}, 0, "diverged"};
    }
}

bool is_done(const Result& result) { return std::strcmp(result.status, "done") == 0; }

/// The errors of one run, and the median of several costs.
Result measure(const study::Subject& subject, const Engine& engine, const Fineness& fineness,
               double limit) {
    Result result = run_or_diverge(subject, engine, fineness, true, limit);
    if (!is_done(result)) return result;
    std::vector<double> costs{result.cost};
    for (int i = 1; i < kRuns; ++i) {
        const Result again = run_or_diverge(subject, engine, fineness, false, 2 * limit);
        if (is_done(again)) costs.push_back(again.cost);
    }
    const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
    std::nth_element(costs.begin(), middle, costs.end());
    result.cost = *middle;
    return result;
}

void print(const study::Subject& subject, const Engine& engine, const char* way, double value,
           const Fineness& fineness, const Result& result) {
    std::size_t next = 0;
    for (const study::Metric& metric : subject.metrics) {
        if (!is_judged(metric)) continue;
        std::printf("%s,%s,%s,%.9g,%.9g,%d,%s,%s,", subject.name.c_str(), engine.name.c_str(), way,
                    value, fineness.dt, fineness.iterations, metric.name.c_str(),
                    metric.unit.c_str());
        if (is_done(result))
            std::printf("%.9g,%.9g,", result.errors[next++], result.cost);
        else
            std::printf(",,");
        std::printf("%s,\n", result.status);
    }
    std::fflush(stdout);
}

/// Ever finer in one way, until a run takes too long. `finer`: the settings at a power of two.
void climb(const study::Subject& subject, const Engine& engine, const char* way, int first,
           int last, double limit, const std::function<Fineness(double)>& finer) {
    for (int power = first; power <= last; ++power) {
        const Fineness fineness = finer(std::ldexp(1, power));
        const Result result = measure(subject, engine, fineness, limit);
        print(subject, engine, way, std::ldexp(1, power), fineness, result);
        if (std::strcmp(result.status, "slow") == 0) return;
    }
}

void sweep(const study::Subject& subject, const Engine& engine, double limit) {
    const std::string reason = subject.scene.deformables.empty()
                                   ? engine.unable(subject.scene)
                                   : "deformables are not handed on to it";
    if (!reason.empty()) {
        std::printf("%s,%s,,,,,,,,,unable,\"%s\"\n", subject.name.c_str(), engine.name.c_str(),
                    reason.c_str());
        return;
    }
    const double dt = subject.scene.settings.dt;
    const int iterations = engine.iterations;
    climb(subject, engine, "step", -2, 10, limit, [&](double by) {
        return Fineness{dt / by, iterations};
    });
    if (iterations == 0) return;
    const auto times = [&](double by) { return static_cast<int>(std::ceil(iterations * by)); };
    climb(subject, engine, "iterations", -1, 5, limit, [&](double by) {
        return Fineness{dt, times(by)};
    });
    climb(subject, engine, "both", 1, 6, limit, [&](double by) {
        return Fineness{dt / by, times(by)};
    });
}

int main_of(int argc, char** argv) {
    double limit = 10;
    std::vector<std::string> names;
    for (int i = 1; i < argc; ++i)
        if (std::strcmp(argv[i], "--limit") == 0 && i + 1 < argc)
            limit = std::atof(argv[++i]);
        else
            names.emplace_back(argv[i]);
    if (names.empty())
        for (const study::CaseEntry& entry : study::cases()) names.emplace_back(entry.name);
    std::puts("case,engine,way,value,dt,iterations,metric,unit,error,cost_us_per_s,status,note");
    for (const std::string& name : names) {
        const study::CaseEntry* entry = study::find_case(name);
        if (!entry) {
            std::fprintf(stderr, "usage: %s [--limit SECONDS] [CASE ...]\nno case \"%s\"\n",
                         argv[0], name.c_str());
            return 2;
        }
        const study::Subject subject = entry->make();
        for (const Engine& engine : engines()) sweep(subject, engine, limit);
    }
    return 0;
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) { return plumb::bench::main_of(argc, argv); }
