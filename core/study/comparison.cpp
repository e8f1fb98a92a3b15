// SPDX-License-Identifier: MIT
#include "study/comparison.h"

#include "measure/within_reach.h"

#include <algorithm>
#include <cmath>

namespace plumb::study {
namespace {

std::vector<ComparedBody> compared_bodies(const Scene& scene, const World& world) {
    std::vector<ComparedBody> bodies(scene.bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const std::uint32_t geometry = scene.bodies[i].geometry;
        if (geometry == kNoIndex) continue;
        const Placement& local = world.bodies.geometry_in_body[i];
        bodies[i] = {&world.shapes[geometry], {to_plain(local.position), to_plain(local.rotation)}};
    }
    return bodies;
}

void add_stats(DetectStats& sum, const DetectStats& s) {
    sum.broad_pairs += s.broad_pairs;
    sum.narrow_pairs += s.narrow_pairs;
    sum.from_backend += s.from_backend;
    sum.from_clip += s.from_clip;
    sum.from_fallback += s.from_fallback;
    sum.shared_normals += s.shared_normals;
}

void note(AnswerFigures& figures, const ContactAnswer& answer) {
    figures.milliseconds.push_back(1e3 * answer.seconds);
    add_stats(figures.sum, answer.stats);
    figures.contacts += answer.contacts.size();
    figures.rejected += answer.rejected;
    if (answer.trouble.empty()) return;
    if (figures.failures++ == 0) figures.first_failure = answer.trouble;
}

ComparisonResult empty_result(const ComparisonPlan& plan, const World& world) {
    ComparisonResult result;
    result.driver = plan.driver;
    for (std::size_t i = 0; i < plan.sources.size(); ++i)
        result.colliders.push_back({plan.sources[i]->info(), plan.own_process[i], {}, {}});
    const std::vector<ComparedBody> bodies = compared_bodies(plan.scene, world);
    for (std::size_t i = 0; i < plan.sources.size(); ++i)
        for (std::size_t j = i + 1; j < plan.sources.size(); ++j) {
            const bool single = result.colliders[i].info.precision == "single" ||
                                result.colliders[j].info.precision == "single";
            result.pairs.push_back({i, j, ContactComparison(bodies, {single, false}),
                                    ContactComparison(bodies, {single, true})});
        }
    result.raw_judged = plan.judge_raw;
    return result;
}

/// Asks all colliders about the present poses, and compares every two answers.
class Look {
public:
    Look(const ComparisonPlan& plan, ComparisonResult& result) : plan_(plan), result_(result) {}

    void at(const World& world) {
        take_poses(poses_, world);
        for (const bool raw : {false, true}) {
            ask(world.settings.margin, raw);
            for (PairFigures& pair : result_.pairs)
                (raw ? pair.raw : pair.clipped)
                    .add({answers_[pair.first].contacts, answers_[pair.second].contacts, poses_,
                          world.settings.margin, world.steps, world.time});
        }
        ++result_.poses;
    }

private:
    void ask(double margin, bool raw) {
        answers_.resize(plan_.sources.size());
        for (std::size_t i = 0; i < answers_.size(); ++i) {
            answers_[i] = plan_.sources[i]->ask({poses_, margin, raw});
            ColliderFigures& figures = result_.colliders[i];
            note(raw ? figures.raw : figures.clipped, answers_[i]);
        }
    }

    const ComparisonPlan& plan_;
    ComparisonResult& result_;
    std::vector<Pose> poses_;
    std::vector<ContactAnswer> answers_;
};

}  // namespace

bool ComparisonResult::answered(std::size_t collider) const {
    const AnswerFigures& f = colliders[collider].clipped;
    return f.failures == 0 && f.rejected == 0;
}

bool ComparisonResult::agrees(const PairFigures& pair) const {
    return answered(pair.first) && answered(pair.second) && alike(pair);
}

bool ComparisonResult::alike(const PairFigures& pair) const {
    return pair.clipped.agrees() && (!raw_judged || pair.raw.agrees());
}

bool ComparisonResult::agrees() const {
    return std::all_of(pairs.begin(), pairs.end(),
                       [this](const PairFigures& pair) { return agrees(pair); });
}

ComparisonResult compare_colliders(const ComparisonPlan& plan, Simulation& simulation,
                                   const ComparisonWatch& watch) {
    ComparisonResult result = empty_result(plan, simulation.world());
    Look look(plan, result);
    const Settings& settings = plan.scene.settings;
    const std::uint64_t steps = step_count(settings);
    for (std::uint64_t i = 0; i <= steps && !result.was_interrupted; ++i) {
        if (i % plan.every == 0) look.at(simulation.world());
        if (i == steps) break;
        const StepReport report = simulation.step();
        const bool goes_on = !watch || watch(i + 1, report.contacts, result.agrees());
        if (!report.finite || !within_reach(simulation.world())) {
            result.diverged_after = simulation.steps();
            break;
        }
        result.was_interrupted = !goes_on;
    }
    result.steps = simulation.steps();
    result.time = simulation.time();
    return result;
}

}  // namespace plumb::study
