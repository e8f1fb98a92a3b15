// SPDX-License-Identifier: MIT
#include "study/self_reference.h"

#include "host/log.h"
#include "host/simulation.h"
#include "measure/deformation.h"
#include "scene/error.h"
#include "study/gauges.h"
#include "study/judges.h"
#include "study/trajectory.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace plumb::study {
namespace {

constexpr int kMoments = 200;                ///< of a trajectory, about
constexpr std::uint32_t kCoarsest = 4;       ///< times dt: the longest step that is compared
constexpr std::uint32_t kFinest = 4096;      ///< substeps to one of the scene's steps, at most
constexpr std::uint32_t kDetections = 8;     ///< to one of the scene's steps
constexpr int kFewest = 2 * int(kCoarsest);  ///< steps of a scene
constexpr double kPatience = 4;   ///< times the seconds that were asked for, after which it ends
constexpr double kParted = 0.01;  ///< share of a body's radius at which prediction ends

using Clock = std::chrono::steady_clock;
using Shared = std::shared_ptr<const Trajectory>;

/// The scene at so many substeps to each of its own steps, in double.
Scene refined(const Scene& scene, std::uint32_t substeps) {
    Scene fine = scene;
    Settings& s = fine.settings;
    const std::uint32_t detections = std::min(kDetections, substeps);
    s.precision = Precision::double_;
    s.leapfrog_start = true;
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
                    const ColliderLibrary& colliders, const ReferenceOptions& options,
                    Clock::time_point deadline) {
    const ErrorsOnly quiet;
    Simulation simulation(scene, colliders, options.collider);
    Trajectory t{interval, {moment_of(simulation.world())}};
    const auto steps = static_cast<std::uint64_t>(std::llround(duration / scene.settings.dt));
    for (std::uint64_t i = 0; i < steps; ++i) {
        if (options.stop && options.stop())
            throw NoReference(NoReference::stopped, "the references were not finished");
        if (Clock::now() > deadline)
            throw NoReference(NoReference::out_of_time,
                              "scene \"" + scene.name +
                                  "\" takes longer than the budget leaves for its references; "
                                  "give it more, or a shorter duration");
        const StepReport report = simulation.step();
        if (report.collider_unusable) throw ColliderError(report.message);
        if (!report.finite)
            throw NoReference(NoReference::runs_off,
                              "scene \"" + scene.name +
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
                         const ReferenceOptions& options, Clock::time_point deadline) {
    constexpr std::uint32_t kTrial = 8;
    constexpr double kShare = 0.05;
    const auto start = Clock::now();
    const double duration = std::max(kShare * scene.settings.duration, scene.settings.dt);
    recorded(refined(scene, kTrial), duration, duration, colliders, options, deadline);
    const double spent = std::chrono::duration<double>(Clock::now() - start).count();
    const double of_one = spent * scene.settings.duration / duration / kTrial;
    std::uint32_t substeps = kTrial;
    while (substeps < kFinest && 1.5 * of_one * 2 * substeps < options.seconds) substeps *= 2;
    return substeps;
}

/// Mean bounding radius of the dynamic bodies and of the deformables, as they are at the start [m].
double size_of(const World& world) {
    double sum = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        if (world.bodies.motion[i] == Motion::dynamic &&
            std::isfinite(world.bodies.bounding_radius[i]))
            sum += world.bodies.bounding_radius[i];
    for (const Deformable& d : world.deformables) {
        const Vector3d centre = centre_of(world, d);
        double radius = 0;
        for (const Vector3d& p : d.spec.points) radius = std::max(radius, (p - centre).norm());
        sum += radius;
    }
    const double mean = sum / (world.dynamic_count + static_cast<double>(world.deformables.size()));
    return mean > 0 ? mean : 1;
}

/// Refuses what has nothing to compare.
void check_length(const Scene& scene, const World& world) {
    if (world.moving_count() == 0)
        throw SceneError(scene.name, "/bodies",
                         "none of them is dynamic, and nothing deforms: there is nothing to "
                         "measure");
    if (scene.settings.duration < kFewest * scene.settings.dt)
        throw SceneError(scene.name, "/settings/duration",
                         "must be at least " + std::to_string(kFewest) + " steps to be measured");
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
    return largest("pose", "m",
                   "largest distance of a body, or of a deformable's particles (rms), from where "
                   "the reference has it",
                   [reference, horizon](const World& w) {
                       const std::size_t i = reference->index_at(w.time);
                       if (i == Trajectory::kNone || w.time > horizon * (1 + 1e-9)) return 0.0;
                       return largest_distance(moment_of(w), reference->moments[i]);
                   });
}

/// A number of each moment of a run.
struct Quantity {
    double (*now)(const World&);
    double Moment::*stored;
};

/// How far a quantity is from that of the reference: the root of the mean square over time.
class MeanAgainst : public Judge {
public:
    MeanAgainst(Shared reference, Quantity quantity, double scale)
        : reference_(std::move(reference)), quantity_(quantity), scale_(scale) {}

    void look(const World& world) override {
        const std::size_t i = reference_->index_at(world.time);
        if (i == Trajectory::kNone || i == 0) return;
        const double difference = quantity_.now(world) - reference_->moments[i].*quantity_.stored;
        square_ += difference * difference;
        ++count_;
    }
    double error() const override { return count_ > 0 ? std::sqrt(square_ / count_) / scale_ : 0; }

private:
    Shared reference_;
    Quantity quantity_;
    double scale_;
    double square_ = 0, count_ = 0;
};

/// The references of a run, and how exact the finer is.
struct References {
    Shared finer, coarser;

    Metric mean(std::string name, std::string unit, std::string what, Quantity quantity,
                double scale = 1) const {
        double square = 0;
        const std::size_t count = std::min(finer->moments.size(), coarser->moments.size());
        for (std::size_t i = 1; i < count; ++i) {
            const double d =
                finer->moments[i].*quantity.stored - coarser->moments[i].*quantity.stored;
            square += d * d / static_cast<double>(count - 1);
        }
        return {std::move(name), std::move(unit), std::move(what),
                [reference = finer, quantity, scale] {
                    return std::make_unique<MeanAgainst>(reference, quantity, scale);
                },
                std::sqrt(square) / scale};
    }
};

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
    check_length(scene, start.world());
    const Clock::time_point deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                           options.substeps > 0 ? 1e9 : kPatience * options.seconds));
    const double interval = interval_of(scene.settings);
    const double duration = scene.settings.duration;
    const std::uint32_t substeps =
        options.substeps > 0 ? options.substeps : affordable(scene, colliders, options, deadline);
    const auto record = [&](std::uint32_t n) {
        return std::make_shared<const Trajectory>(
            recorded(refined(scene, n), interval, duration, colliders, options, deadline));
    };
    const References references{record(substeps), record(substeps / 2)};
    const auto& [finer, coarser] = references;
    const std::size_t parted = together(*finer, *coarser, kParted * size_of(start.world()));

    Subject s;
    s.name = name;
    s.title = scene.description.empty() ? scene.name : scene.description;
    s.scene = scene;
    s.reference = "a run of " + std::to_string(substeps) + " substeps to each step of " +
                  std::to_string(scene.settings.dt) + " s, in double";
    s.reference_substeps = substeps;
    const bool ends = parted + 1 < finer->moments.size();
    const double horizon = static_cast<double>(parted) * interval;
    if (parted > 0) {
        s.metrics.push_back(pose_metric(finer, horizon));
        s.horizon = ends ? horizon : 0;
        double& error = s.metrics.front().reference_error;
        for (std::size_t i = 0; i <= parted; ++i)
            error = std::max(error, largest_distance(finer->moments[i], coarser->moments[i]));
    }
    s.metrics.push_back(references.mean("height", "m", "error of the mean height, rms over time",
                                        {mean_height, &Moment::height}));
    s.metrics.push_back(
        references.mean("energy", "", "error of the energy over what was in motion, rms over time",
                        {energy, &Moment::energy}, turnover(*finer)));
    s.metrics.push_back(references.mean("momentum", "m/s",
                                        "error of the momentum over all mass, rms over time",
                                        {mean_speed, &Moment::speed}));
    if (!start.world().deformables.empty())
        s.metrics.push_back(references.mean("strain", "",
                                            "error of the deformables' mean strain, rms over time",
                                            {mean_strain, &Moment::strain}));
    for (Metric& gauge : gauges_of(start.plan(), start.world()))
        s.metrics.push_back(std::move(gauge));
    return s;
}

}  // namespace plumb::study
