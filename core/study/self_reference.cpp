// SPDX-License-Identifier: MIT
#include "study/self_reference.h"

#include "host/simulation.h"
#include "measure/measure.h"
#include "study/gauges.h"
#include "study/judges.h"
#include "study/trajectory.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

namespace plumb::study {
namespace {

constexpr int kMoments = 200;             ///< of a trajectory, about
constexpr std::uint32_t kCoarsest = 4;    ///< times dt: the longest step that is compared
constexpr std::uint32_t kFinest = 4096;   ///< substeps to one of the scene's steps, at most
constexpr std::uint32_t kDetections = 8;  ///< to one of the scene's steps
constexpr double kParted = 0.01;          ///< share of a body's radius at which prediction ends

using Shared = std::shared_ptr<const Trajectory>;

/// The scene at so many substeps to each of its own steps, in double.
Scene refined(const Scene& scene, std::uint32_t substeps) {
    Scene fine = scene;
    Settings& s = fine.settings;
    const std::uint32_t detections = std::min(kDetections, substeps);
    s.precision = Precision::double_;
    s.dt /= detections;
    s.substeps = substeps / detections;
    s.velocity_iterations = std::max(2u, s.velocity_iterations);
    s.position_iterations = std::max(2u, s.position_iterations);
    return fine;
}

double interval_of(const Settings& s) {
    const double step = kCoarsest * s.dt;
    return step * std::max(1.0, std::floor(s.duration / step / kMoments));
}

Trajectory recorded(const Scene& scene, double interval, double duration,
                    const ColliderLibrary& colliders, const ReferenceOptions& options) {
    Simulation simulation(scene, colliders, options.collider);
    Trajectory t{interval, {moment_of(simulation.world())}};
    const auto steps = static_cast<std::uint64_t>(std::llround(duration / scene.settings.dt));
    for (std::uint64_t i = 0; i < steps; ++i) {
        if (options.stop && options.stop())
            throw std::runtime_error("the references were not finished");
        if (!simulation.step().finite)
            throw std::runtime_error("scene \"" + scene.name +
                                     "\" runs off however finely it is stepped: after " +
                                     std::to_string(simulation.time()) + " s");
        if (t.index_at(simulation.time()) == Trajectory::kNone &&
            std::abs(std::remainder(simulation.time(), interval)) < 1e-6 * interval)
            t.moments.push_back(moment_of(simulation.world()));
    }
    return t;
}

/// Substeps to one of the scene's steps that two references may have in the time: by how long a
/// short run takes.
std::uint32_t affordable(const Scene& scene, const ColliderLibrary& colliders,
                         const ReferenceOptions& options) {
    constexpr std::uint32_t kTrial = 16;
    constexpr double kShare = 0.03;
    const auto start = std::chrono::steady_clock::now();
    const double duration = std::max(kShare * scene.settings.duration, scene.settings.dt);
    recorded(refined(scene, kTrial), duration, duration, colliders, options);
    const double spent =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double of_one = spent * scene.settings.duration / duration / kTrial;
    std::uint32_t substeps = 2 * kTrial;
    while (substeps < kFinest && 1.5 * of_one * 2 * substeps < options.seconds) substeps *= 2;
    return substeps;
}

/// Mean reach of the dynamic bodies [m].
double size_of(const World& world) {
    double sum = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        if (world.bodies.motion[i] == Motion::dynamic && std::isfinite(world.bodies.reach[i]))
            sum += world.bodies.reach[i];
    const double mean = sum / std::max(1, world.dynamic_count);
    return mean > 0 ? mean : 1;
}

/// How long two runs stay together: index of the last moment of that.
std::size_t together(const Trajectory& a, const Trajectory& b, double distance) {
    std::size_t last = 0;
    while (last + 1 < std::min(a.moments.size(), b.moments.size()) &&
           largest_distance(a.moments[last + 1], b.moments[last + 1]) < distance)
        ++last;
    return last;
}

Metric pose_metric(const Shared& reference, double horizon) {
    return largest("pose", "m", "largest distance of a body from where the reference has it",
                   [reference, horizon](const World& w) {
                       const std::size_t i = reference->index_at(w.time);
                       if (i == Trajectory::kNone || w.time > horizon * (1 + 1e-9)) return 0.0;
                       return largest_distance(moment_of(w), reference->moments[i]);
                   });
}

/// Compares a value's mean over time with that of the reference.
class MeanAgainst : public Judge {
public:
    MeanAgainst(Shared reference, double Moment::*value, double scale)
        : reference_(std::move(reference)), value_(value), scale_(scale) {}

    void look(const World& world) override {
        const std::size_t i = reference_->index_at(world.time);
        if (i == Trajectory::kNone || i == 0) return;
        difference_ += moment_of(world).*value_ - reference_->moments[i].*value_;
        ++count_;
    }
    double error() const override {
        return count_ > 0 ? std::abs(difference_) / count_ / scale_ : 0;
    }

private:
    Shared reference_;
    double Moment::*value_;
    double scale_;
    double difference_ = 0, count_ = 0;
};

Metric mean_metric(std::string name, std::string unit, std::string what, const Shared& reference,
                   double Moment::*value, double scale) {
    return {std::move(name), std::move(unit), std::move(what),
            [=] { return std::make_unique<MeanAgainst>(reference, value, scale); }};
}

/// What energy was turned over: the most that was ever in motion [J].
double turnover(const Trajectory& t) {
    double most = 0;
    for (const Moment& m : t.moments) most = std::max(most, m.kinetic_energy);
    return most > 0 ? most : 1;
}

}  // namespace

Subject self_referenced(const Scene& scene, const std::string& name,
                        const ColliderLibrary& colliders, const ReferenceOptions& options) {
    const Simulation start(scene, colliders, options.collider);
    const double interval = interval_of(scene.settings);
    const double duration = scene.settings.duration;
    const std::uint32_t substeps = affordable(scene, colliders, options);
    const auto record = [&](std::uint32_t n) {
        return std::make_shared<const Trajectory>(
            recorded(refined(scene, n), interval, duration, colliders, options));
    };
    const Shared finer = record(substeps), coarser = record(substeps / 2);
    const std::size_t last = together(*finer, *coarser, kParted * size_of(start.world()));

    Subject s;
    s.name = name;
    s.title = scene.description.empty() ? scene.name : scene.description;
    s.scene = scene;
    s.reference = "a run of " + std::to_string(substeps) + " substeps to each step of " +
                  std::to_string(scene.settings.dt) + " s, in double";
    const bool ends = last + 1 < finer->moments.size();
    const double horizon = static_cast<double>(last) * interval;
    if (last > 0) {
        s.metrics.push_back(pose_metric(finer, horizon));
        s.horizon = ends ? horizon : 0;
        for (std::size_t i = 0; i <= last; ++i)
            s.reference_error = std::max(s.reference_error,
                                         largest_distance(finer->moments[i], coarser->moments[i]));
    }
    s.metrics.push_back(mean_metric("height", "m", "mean height over time, against the reference",
                                    finer, &Moment::height, 1));
    s.metrics.push_back(mean_metric("energy", "",
                                    "mean energy over time, against the reference's turnover",
                                    finer, &Moment::energy, turnover(*finer)));
    for (Metric& gauge : gauges_of(start.plan())) s.metrics.push_back(std::move(gauge));
    return s;
}

}  // namespace plumb::study
