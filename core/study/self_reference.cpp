// SPDX-License-Identifier: MIT
#include "study/self_reference.h"

#include "host/log.h"
#include "host/simulation.h"
#include "measure/deformation.h"
#include "scene/error.h"
#include "study/gauges.h"
#include "study/judges.h"
#include "study/trajectory.h"
#include "world/sleep.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

namespace plumb::study {
namespace {

constexpr int kMoments = 200;                  ///< of a trajectory, about
constexpr std::uint32_t kCoarsest = 4;         ///< times dt: the longest step that is compared
constexpr std::uint32_t kFinest = 4096;        ///< substeps to one of the scene's steps, at most
constexpr std::uint32_t kDetections = 8;       ///< to one of the scene's steps, at least
constexpr std::uint32_t kToDetection = 4;      ///< substeps, at least where that leaves as many
constexpr int kFewest = 2 * int(kCoarsest);    ///< steps of a scene
constexpr std::uint32_t kFirst = 4;            ///< substeps of the coarsest reference
constexpr std::uint32_t kLeastIterations = 4;  ///< of either kind in the coarsest one, at least
constexpr double kDearer = 2.9;        ///< times a reference that the next one costs: twice the
                                       ///< substeps, and the root of two of the iterations
constexpr double kAhead = 4;           ///< times as far as prediction went, the next reference runs
constexpr double kForFirst = 1. / 16;  ///< of the seconds, that the coarsest one may take
constexpr double kPatience = 4;      ///< times the seconds that were asked for, after which it ends
constexpr double kParted = 0.01;     ///< share of a body's radius at which prediction ends
constexpr double kKnownWell = 0.15;  ///< share of a wanted error that a reference may have

using Clock = std::chrono::steady_clock;
using Shared = std::shared_ptr<const Trajectory>;

/// Iterations of a reference, for what a scene's settings ask for. They grow as the root of its
/// substeps: an impact is over within a substep or two, and what its iterations leave out would be
/// the same in all references, however short their substeps.
std::uint32_t refined_iterations(std::uint32_t asked, std::uint32_t substeps) {
    const double finer = std::max(1.0, static_cast<double>(substeps) / kFirst);
    return static_cast<std::uint32_t>(
        std::lround(std::max(kLeastIterations, asked) * std::sqrt(finer)));
}

/// The scene at so many substeps to each of its own steps, in double. Detections get closer
/// together as substeps do: else all references would share what their interval costs in exactness.
Scene refined(const Scene& scene, std::uint32_t substeps) {
    Scene fine = scene;
    Settings& s = fine.settings;
    const std::uint32_t detections =
        std::max(std::min(kDetections, substeps), substeps / kToDetection);
    s.precision = Precision::double_;
    s.leapfrog_start = true;
    s.dt /= detections;
    s.substeps = substeps / detections;
    s.velocity_iterations = refined_iterations(s.velocity_iterations, substeps);
    s.position_iterations = refined_iterations(s.position_iterations, substeps);
    return fine;
}

double interval_of(const Settings& s) {
    const double step = kCoarsest * s.dt;
    return step * std::max(1.0, std::floor(s.duration / step / kMoments));
}

/// How far a reference goes: for so long [s of the scene], or until its time is up.
struct Length {
    double duration = 0;
    Clock::time_point until = Clock::time_point::max();
};

Trajectory recorded(const Scene& scene, double interval, const Length& length,
                    const ColliderLibrary& colliders, const ReferenceOptions& options,
                    Clock::time_point deadline) {
    const ErrorsOnly quiet;
    Simulation simulation(scene, colliders, options.collider);
    Trajectory t{interval, {moment_of(simulation.world())}};
    const auto steps =
        static_cast<std::uint64_t>(std::llround(length.duration / scene.settings.dt));
    for (std::uint64_t i = 0; i < steps; ++i) {
        if (options.stop && options.stop())
            throw NoReference(NoReference::stopped, "the references were not finished");
        const Clock::time_point now = Clock::now();
        if (now > deadline)
            throw NoReference(NoReference::out_of_time,
                              "scene \"" + scene.name +
                                  "\" takes longer than the budget leaves for its references; "
                                  "give it more, or a shorter duration");
        if (now > length.until && t.moments.size() > kFewest) break;
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

/// Mean bounding radius of the dynamic bodies and of the deformables, as they are at the start [m].
double size_of(const World& world) {
    double sum = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        if (is_movable(world.bodies.motion[i]) && std::isfinite(world.bodies.bounding_radius[i]))
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

/// Error of the finest of three runs, each twice as fine as the one before, by how far the finest
/// is from the second, and the second from the coarsest. Where the error falls as a power of the
/// substeps, the first distance is as many times the error as the power of two less one says. The
/// error is never taken to be less than that distance, to fall more slowly than as the root, nor
/// more quickly than in proportion: two runs may be close by chance.
double error_of_finest(double to_second, double second_to_coarsest) {
    const double falls =
        to_second > 0 ? std::max(second_to_coarsest / to_second, std::numbers::sqrt2) : 2;
    return std::max({to_second, to_second / (falls - 1), 0.5 * second_to_coarsest});
}

/// Root of the mean square over time of how far two runs' quantities are apart.
double apart(const Trajectory& a, const Trajectory& b, double Moment::*quantity) {
    const std::size_t count = std::min(a.moments.size(), b.moments.size());
    double square = 0;
    for (std::size_t i = 1; i < count; ++i) {
        const double d = a.moments[i].*quantity - b.moments[i].*quantity;
        square += d * d / static_cast<double>(count - 1);
    }
    return std::sqrt(square);
}

/// The last references of a run.
struct References {
    Shared finest, second, coarsest;

    Metric mean(std::string name, std::string unit, std::string what, Quantity quantity,
                double scale = 1) const {
        return {std::move(name), std::move(unit), std::move(what),
                [reference = finest, quantity, scale] {
                    return std::make_unique<MeanAgainst>(reference, quantity, scale);
                },
                error_of_finest(apart(*finest, *second, quantity.stored),
                                apart(*second, *coarsest, quantity.stored)) /
                    scale};
    }

    /// Error of the finest one's poses up to each of its moments.
    std::vector<double> pose_errors() const {
        const std::size_t count =
            std::min({finest->moments.size(), second->moments.size(), coarsest->moments.size()});
        std::vector<double> errors;
        double first = 0, last = 0, most = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Moment& middle = second->moments[i];
            first = std::max(first, largest_distance(finest->moments[i], middle));
            last = std::max(last, largest_distance(middle, coarsest->moments[i]));
            errors.push_back(most = std::max(most, error_of_finest(first, last)));
        }
        return errors;
    }
};

/// What energy was turned over: the most that was ever in motion [J].
double turnover(const Trajectory& t) {
    double most = 0;
    for (const Moment& m : t.moments) most = std::max(most, m.kinetic_energy);
    return most > 0 ? most : 1;
}

/// What can be measured against the references, and until when.
void put_metrics(Subject& s, const References& references, double parted, bool deforms) {
    const Trajectory& finest = *references.finest;
    const std::vector<double> errors = references.pose_errors();
    const std::size_t known =
        static_cast<std::size_t>(std::ranges::upper_bound(errors, parted) - errors.begin());
    s.metrics.clear();
    s.horizon = 0;
    if (known > 1) {
        const double horizon = static_cast<double>(known - 1) * finest.interval;
        s.metrics.push_back(pose_metric(references.finest, horizon));
        s.metrics.front().reference_error = errors[known - 1];
        // what is known of one that was not run to the end, is so until where that ends
        if (horizon + finest.interval <= s.scene.settings.duration) s.horizon = horizon;
    }
    s.metrics.push_back(references.mean("height", "m", "error of the mean height, rms over time",
                                        {mean_height, &Moment::height}));
    s.metrics.push_back(
        references.mean("energy", "", "error of the energy over what was in motion, rms over time",
                        {energy, &Moment::energy}, turnover(finest)));
    s.metrics.push_back(references.mean("momentum", "m/s",
                                        "error of the momentum over all mass, rms over time",
                                        {mean_speed, &Moment::speed}));
    if (deforms)
        s.metrics.push_back(references.mean("strain", "",
                                            "error of the deformables' mean strain, rms over time",
                                            {mean_strain, &Moment::strain}));
}

/// Whether the references tell the error that is wanted, over all the time.
bool are_known_well(const Subject& s, const ReferenceOptions& options) {
    for (const Metric& m : s.metrics)
        if (m.name == options.metric || (options.metric.empty() && &m == &s.metrics.front()))
            return m.reference_error <= kKnownWell * options.error &&
                   (s.horizon == 0 || m.name != "pose");
    return options.error > 0;  // needs none
}

/// What the finest reference is.
std::string sentence(const Subject& s, const Settings& whole) {
    std::ostringstream text;
    text << "a run of " << s.reference_substeps << " substeps to each step of " << whole.dt
         << " s, in double";
    if (s.scene.settings.duration < whole.duration - 0.5 * whole.dt)
        text << ", of the first " << s.scene.settings.duration << " of " << whole.duration << " s";
    return text.str();
}

}  // namespace

Subject self_referenced(const Scene& scene, const std::string& name,
                        const ColliderLibrary& colliders, const ReferenceOptions& options) {
    const Simulation start(scene, colliders, options.collider);
    check_length(scene, start.world());
    const auto began = Clock::now();
    const auto spent = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
    const double patience = options.substeps > 0 ? 1e9 : kPatience * options.seconds;
    const auto after = [&](double seconds) {
        return began +
               std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    };
    const Clock::time_point deadline = after(patience);
    const double interval = interval_of(scene.settings);
    const double parted =
        options.error > 0 ? kKnownWell * options.error : kParted * size_of(start.world());

    Subject s;
    s.name = name;
    s.title = scene.description.empty() ? scene.name : scene.description;
    s.scene = scene;
    References references;
    // poses are wanted for as long as they can be predicted, and no longer
    const bool follows_prediction = options.substeps == 0 && options.error > 0 &&
                                    (options.metric.empty() || options.metric == "pose");
    Length length{scene.settings.duration};
    if (follows_prediction) length.until = after(kForFirst * options.seconds);
    for (std::uint32_t n = options.substeps > 0 ? options.substeps / 4 : kFirst;; n *= 2) {
        const double before = spent(), went = length.duration;
        references = {std::make_shared<const Trajectory>(recorded(
                          refined(scene, n), interval, length, colliders, options, deadline)),
                      references.finest, references.second};
        const double took = spent() - before;
        if (follows_prediction && !references.second)
            length = Length{static_cast<double>(references.finest->moments.size() - 1) * interval};
        if (!references.coarsest) continue;
        put_metrics(s, references, parted, !start.world().deformables.empty());
        s.reference_substeps = n;
        if (follows_prediction && s.metrics.front().name == "pose" && s.horizon > 0)
            length.duration = std::min(scene.settings.duration, kAhead * s.horizon);
        const double next = kDearer * took * length.duration / went;
        if (options.substeps > 0
                ? n >= options.substeps
                : n >= kFinest || spent() + next > options.seconds || are_known_well(s, options))
            break;
    }
    if (follows_prediction)
        s.scene.settings.duration =
            std::min(scene.settings.duration,
                     static_cast<double>(references.finest->moments.size() - 1) * interval);
    s.reference = sentence(s, scene.settings);
    for (Metric& gauge : gauges_of(start.plan(), start.world()))
        s.metrics.push_back(std::move(gauge));
    return s;
}

}  // namespace plumb::study
