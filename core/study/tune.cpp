// SPDX-License-Identifier: MIT
#include "study/tune.h"

#include "effects/plan.h"
#include "study/sweep_plan.h"
#include "world/world.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace plumb::study {
namespace {

/// What is varied.
struct Choice {
    std::uint32_t substeps = 8, iterations = 1;
    double step_share = 1;  ///< of the scene's dt
    bool is_double = false;
    std::string joints;    ///< "" as the scene says
    std::string collider;  ///< by name
    bool raw = false;      ///< contacts as the collider's package has them

    bool operator==(const Choice&) const = default;
};

class Tuner {
public:
    Tuner(const Subject& subject, const ColliderLibrary& colliders, const TuneOptions& options)
        : subject_(subject),
          colliders_(colliders),
          options_(options),
          allowed_(options.error - subject.metrics.front().reference_error) {
        const World world = build_world(subject.scene);
        const Plan plan = make_plan(world);
        has_joints_ = plan.runs(Effect::joints);
        sweeps_ = plan.runs(Effect::contacts) || world.particles.size() > 0 ||
                  (has_joints_ && !plan.runs(Effect::joint_trees));
        solves_trees_ = plan.runs(Effect::joint_trees);
        touches_ = plan.runs(Effect::contacts);
        able_ = options.collider == "auto" ? able_colliders(subject.scene, colliders)
                                           : std::vector{options.collider};
    }

    TuneResult run() {
        colliders_.check_abilities(colliders_.find(able_.front()), subject_.scene);
        Choice first;
        first.collider = able_.front();
        if (has_joints_) first = likelier_of(first, joints_otherwise(first));
        sweeps_ |= first.joints == "iterate";
        Choice best = refine(first, &Choice::substeps);
        best = with_finer_steps(first, best);
        if (!reaches(best) && options_.error > 0) {
            Choice exact = best;
            exact.is_double = true;
            best = better_of(best, exact);
        }
        best = with_other_contacts(best);
        if (sweeps_) best = better_of(best, many_iterations(best));
        best = undivided(best);
        for (const bool coarser : {true, false}) best = walk(best, coarser);
        if (has_joints_) best = better_of(best, joints_otherwise(best));
        if (sweeps_ && best.substeps > 1) best = better_of(best, with_iterations(best));
        verify(best);
        return std::move(result_);
    }

private:
    using Knob = std::uint32_t Choice::*;  ///< what is refined
    static constexpr std::uint32_t kMost = 2048;

    /// Runs that may be made before the one that verifies.
    bool may_run() {
        result_.ran_out |= is_late();
        return !result_.ran_out && result_.trials.size() + 1 < options_.most_runs;
    }

    bool is_late() const {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
        return spent.count() > options_.seconds;
    }

    Point point_of(const Choice& c) const {
        Point p{.subject = subject_.name,
                .curve = "tuned",
                .precision = c.is_double ? "double" : "single",
                .ladder = Ladder::substeps,
                .value = static_cast<double>(c.substeps),
                .collider = c.collider,
                .contacts = c.raw ? "raw" : "shared",
                .settings = {}};
        if (c.step_share != 1)
            p.settings.push_back("dt=" + number_text(c.step_share * subject_.scene.settings.dt));
        p.settings.push_back("leapfrog_start=true");  // costs nothing, and never is of lower order
        p.settings.push_back("precision=" + p.precision);
        p.settings.push_back("substeps=" + std::to_string(c.substeps));
        for (const char* pass : {"velocity_iterations=", "position_iterations="})
            p.settings.push_back(pass + std::to_string(c.iterations));
        if (!c.joints.empty()) p.settings.push_back("joints=" + c.joints);
        if (c.raw) p.settings.push_back("contacts=raw");
        return p;
    }

    /// The trial of a choice; made unless it was, nullptr where no run is left.
    const Trial* trial(const Choice& c) {
        for (std::size_t i = 0; i < choices_.size(); ++i)
            if (choices_[i] == c) return &result_.trials[i];
        if (!may_run()) return nullptr;
        const Point point = point_of(c);
        if (options_.progress)
            options_.progress(static_cast<std::uint32_t>(result_.trials.size()) + 1,
                              options_.most_runs, point);
        choices_.push_back(c);
        const Stop stop = [this] { return (options_.stop && options_.stop()) || is_late(); };
        result_.trials.push_back({point, run_point(subject_, point, colliders_, true, stop)});
        return &result_.trials.back();
    }

    double error_of(const Choice& c) {
        const Trial* t = trial(c);
        return t ? t->error() : std::numeric_limits<double>::infinity();
    }
    double cost_of(const Choice& c) {
        const Trial* t = trial(c);
        return t && t->is_done() ? t->outcome.cost.total : std::numeric_limits<double>::infinity();
    }

    bool reaches(const Choice& c) {
        return (options_.error <= 0 || error_of(c) <= allowed_) && cost_of(c) <= options_.time;
    }

    /// Of two choices the one that reaches what is wanted; of two that do, the cheaper, or the more
    /// exact where time is given.
    Choice better_of(const Choice& a, const Choice& b) {
        if (reaches(a) != reaches(b)) return reaches(a) ? a : b;
        if (options_.error > 0 && reaches(a)) return cost_of(b) < cost_of(a) ? b : a;
        return error_of(b) < error_of(a) ? b : a;
    }

    /// Of two choices the one from which less is left to pay for, if the error falls as the cost
    /// grows.
    Choice likelier_of(const Choice& a, const Choice& b) {
        const double left_of_a = error_of(a) * cost_of(a), left_of_b = error_of(b) * cost_of(b);
        return left_of_b < left_of_a ? b : a;
    }

    /// How many will do of what is refined, by the two trials that came last: the error as a power
    /// of it, or the cost in proportion.
    std::uint32_t foretold(const Choice& before, const Choice& last, Knob knob) {
        double factor = 2;
        if (options_.error > 0) {
            const double falls = std::log(error_of(before) / error_of(last));
            const double finer = std::log(double(last.*knob) / before.*knob);
            const double order = std::clamp(falls / finer, 0.5, 4.0);
            if (std::isfinite(falls))
                factor = std::pow(error_of(last) / (kAim * allowed_), 1 / order);
        } else {
            factor = kAim * options_.time / cost_of(last);
        }
        const double wanted = std::clamp(factor, 1.0 / 16, kFarthest) * last.*knob;
        return static_cast<std::uint32_t>(std::clamp(std::ceil(wanted), 1.0, double(kMost)));
    }

    /// Whether more no longer help: the error is that of the steps between detections, or, of
    /// iterations, that of the substeps.
    bool has_stalled(const Choice& before, const Choice& last, Knob knob) {
        return options_.error > 0 && !reaches(last) && last.*knob > before.*knob &&
               error_of(last) > kStalls * error_of(before);
    }

    /// As many substeps or iterations as just reach what is wanted, all else as in `start`.
    Choice refine(const Choice& start, Knob knob) {
        Choice before = start, last = start;
        last.*knob = 2 * start.*knob;
        error_of(before);
        Choice best = better_of(before, last);
        for (int i = 0; i < kRefinements && may_run() && !has_stalled(before, last, knob); ++i) {
            Choice next = last;
            next.*knob = foretold(before, last, knob);
            if (next.*knob == last.*knob || next.*knob == before.*knob) break;
            error_of(next);
            best = better_of(best, next);
            before = last, last = next;
            if (reaches(last) && error_of(last) > kNearEnough * allowed_) break;
            const double apart =
                double(std::max(last.*knob, before.*knob)) / std::min(last.*knob, before.*knob);
            if (reaches(last) != reaches(before) && apart < kCloseEnough) break;
        }
        return best;
    }

    /// Shorter steps, until they reach what is wanted. Where they do not help, joints are solved
    /// the other way: in simultaneous impacts the two may converge to different motions.
    Choice with_finer_steps(const Choice& start, Choice best) {
        Choice finer = start;
        finer.substeps = 4, finer.step_share = 0.25;
        bool was_other = !has_joints_;
        while (options_.error > 0 && error_of(best) > allowed_ && may_run() &&
               finer.step_share > kFinestStep) {
            const double before = error_of(best);
            best = better_of(best, refine(finer, &Choice::substeps));
            const bool helps = error_of(best) <= kStalls * before;
            if (helps || was_other)
                finer.step_share /= 4;
            else
                finer = joints_otherwise(finer), was_other = true;
        }
        return best;
    }

    /// The same substeps with detections half as often, or twice, as long as that helps. A step
    /// that is not divided is made longer itself, with more iterations, but fewer in all.
    Choice walk(Choice best, bool coarser) {
        for (int i = 0; i < 2; ++i) {
            Choice next = best;
            next.step_share *= coarser ? 2 : 0.5;
            if (!coarser) next.substeps = best.substeps / 2;
            if (coarser && best.substeps > 1) next.substeps = 2 * best.substeps;
            if (coarser && best.substeps == 1 && sweeps_) next.iterations += best.iterations / 2;
            if (next.substeps == 0 || next.step_share > 4 || !may_run()) break;
            const Choice better = better_of(best, next);
            if (better == best) break;
            best = better;
        }
        return best;
    }

    /// The scene's steps undivided, with as many iterations as just reach what is wanted.
    Choice many_iterations(const Choice& best) {
        Choice single = best;
        single.step_share = 1, single.substeps = 1;
        single.iterations = kManyIterations;
        return refine(single, &Choice::iterations);
    }

    /// The same with the contacts of the collider's package, and with other colliders, where
    /// detections cost much of the time.
    Choice with_other_contacts(Choice best) {
        if (!touches_ || of_detections(best) < options_.detections * cost_of(best)) return best;
        Choice raw = best;
        raw.raw = true;
        best = better_of(best, raw);
        for (const std::string& name : able_) {
            Choice other = best;
            other.collider = name;
            best = better_of(best, other);
        }
        return best;
    }

    /// Each substep a step of its own, with a detection and a single iteration, where that may be
    /// cheaper.
    Choice undivided(const Choice& best) {
        if (best.substeps == 1 || !sweeps_) return best;
        const double detections = of_detections(best), solver = cost_of(best) - detections;
        if (best.substeps * detections + solver / best.iterations > cost_of(best)) return best;
        Choice next = best;
        next.step_share /= best.substeps;
        next.substeps = next.iterations = 1;
        return better_of(best, next);
    }

    /// Cost of the collider's calls [µs/s].
    double of_detections(const Choice& c) {
        const Trial* t = trial(c);
        return t && t->is_done() ? t->outcome.cost.total - t->outcome.cost.solver : 0;
    }

    Choice joints_otherwise(Choice c) const {
        c.joints = !c.joints.empty() ? "" : solves_trees_ ? "iterate" : "tree";
        return c;
    }

    static Choice with_iterations(Choice c) {
        c.substeps /= 2;
        c.iterations *= 2;
        return c;
    }

    /// One more run of the best, whose figures are the result's.
    void verify(const Choice& best) {
        if (!reaches(best)) return;
        const Point point = point_of(best);
        Outcome outcome = run_point(subject_, point, colliders_, true, options_.stop);
        if (outcome.status == Status::done) result_.best = Trial{point, std::move(outcome)};
    }

    static constexpr double kAim = 0.9;  ///< share of what is allowed that is aimed at
    static constexpr double kNearEnough = 0.7;
    static constexpr double kFarthest = 4, kCloseEnough = 1.4;  ///< of what is refined, as a factor
    static constexpr double kStalls = 0.85, kFinestStep = 1.0 / 100;
    static constexpr int kRefinements = 4;
    static constexpr std::uint32_t kManyIterations = 10;  ///< of an undivided step, tried first

    const Subject& subject_;
    const ColliderLibrary& colliders_;
    const TuneOptions& options_;
    double allowed_;  ///< error against the reference
    bool has_joints_ = false, solves_trees_ = false;
    bool sweeps_ = false;            ///< whether iterations change anything
    bool touches_ = false;           ///< whether there are contacts
    std::vector<std::string> able_;  ///< colliders that may be chosen, the likeliest first
    std::vector<Choice> choices_;    ///< [trial]
    TuneResult result_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

TuneResult tune(const Subject& subject, const ColliderLibrary& colliders,
                const TuneOptions& options) {
    return Tuner(subject, colliders, options).run();
}

}  // namespace plumb::study
