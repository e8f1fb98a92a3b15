// SPDX-License-Identifier: MIT
/// Sweeps: whole, cut off and resumed, in parts; scenes against finer runs of themselves; tuning.
#include "study/sweep.h"
#include "study/cases.h"
#include "study/findings.h"
#include "study/journal.h"
#include "study/self_reference.h"
#include "study/tune.h"
#include "support/scenes.h"
#include "support/soft.h"

#include "output/error.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace plumb::test {
namespace {

using namespace study;
namespace fs = std::filesystem;

/// A folder that goes with the test.
class Sweeps : public testing::Test {
protected:
    Sweeps() { fs::remove_all(folder_); }
    ~Sweeps() override { fs::remove_all(folder_); }
    std::string in(const std::string& name) const { return (folder_ / name).string(); }

    static std::vector<Subject> subjects() {
        std::vector<Subject> all{find_case("parabola")->make()};
        all.front().scene.settings.duration = 0.5;
        return all;
    }

private:
    fs::path folder_ = fs::temp_directory_path() /
                       ("plumb_sweeps_" +
                        std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

/// All that a table says, times aside.
std::string without_times(StudyTable table) {
    std::ostringstream text;
    text.precision(17);
    for (const Row& r : table.rows) {
        text << r.point.key() << ' ' << name_of(r.status) << ' ' << r.note;
        for (const double e : r.errors) text << ' ' << e;
        text << '\n';
    }
    return text.str();
}

StudyTable swept(const std::vector<Subject>& subjects, const std::string& folder,
                 SweepOptions options) {
    StudyTable table = plan_sweep(subjects, {}, colliders());
    Journal journal(folder, table);
    options.repeats = 2;
    options.ran = [&](std::size_t row, bool judged, const Outcome& o) {
        journal.add(row, judged, o);
    };
    sweep(table, subjects, colliders(), options);
    return table;
}

TEST_F(Sweeps, RunEveryPointAndFindTheOrder) {
    const auto all = subjects();
    const StudyTable table = swept(all, in("whole"), {});
    for (const Row& r : table.rows) {
        EXPECT_EQ(r.status, study::Status::done) << r.point.key() << ": " << r.note;
        EXPECT_EQ(r.costs.size(), 2u);
    }
    bool measured = false;
    for (const CurveRows& c : curves_of(table)) {
        if (c.curve != "pbd" || c.precision != "double" || c.ladder != Ladder::substeps) continue;
        const auto slope = slope_of(table, c);
        ASSERT_TRUE(slope);
        EXPECT_NEAR(slope->order, slope->expected, 0.15);
        measured = true;
    }
    EXPECT_TRUE(measured);
}

TEST_F(Sweeps, GoOnWhereTheyWereCutOff) {
    const auto all = subjects();
    const StudyTable whole = swept(all, in("whole"), {});
    int runs = 0;
    SweepOptions cut;
    cut.interrupted = [&] { return ++runs > 4000; };  // asked once a step
    const StudyTable half = swept(all, in("cut"), cut);
    ASSERT_NE(without_times(half), without_times(whole)) << "it was not cut off";
    // killed while a line was written
    std::ofstream(in("cut") + "/runs.csv", std::ios::app) << "3,1,done,12.";
    EXPECT_EQ(without_times(swept(all, in("cut"), {})), without_times(whole));
}

TEST_F(Sweeps, PartsMakeTheWhole) {
    const auto all = subjects();
    const StudyTable whole = swept(all, in("whole"), {});
    std::vector<std::string> folders;
    for (std::uint32_t i = 1; i <= 4; ++i) {
        folders.push_back(in("part" + std::to_string(i)));
        SweepOptions part;
        part.shard = i;
        part.of = 4;
        swept(all, folders.back(), part);
    }
    EXPECT_EQ(without_times(merged(folders)), without_times(whole));
    folders.pop_back();
    EXPECT_NE(without_times(merged(folders)), without_times(whole));
}

TEST_F(Sweeps, RefuseTheFolderOfAnother) {
    const auto all = subjects();
    StudyTable table = plan_sweep(all, {}, colliders());
    { const Journal journal(in("a"), table); }
    StudyTable other = plan_sweep({find_case("pendulum")->make()}, {}, colliders());
    EXPECT_THROW(Journal(in("a"), other), OutputError);
    { const Journal journal(in("b"), other); }
    EXPECT_THROW(merged({in("a"), in("b")}), OutputError);
    EXPECT_THROW(merged({in("absent")}), OutputError);
}

TEST_F(Sweeps, NotesWhatTheBudgetLeftOut) {
    SweepOptions options;
    options.budget = 1e-9;
    const StudyTable table = swept(subjects(), in("poor"), options);
    for (const Row& r : table.rows) {
        EXPECT_EQ(r.status, study::Status::not_run);
        EXPECT_FALSE(r.note.empty());
    }
}

/// A run in double precision on the reference collider.
Point point_at(const char* subject, const char* substeps) {
    return {.subject = subject,
            .curve = "pbd",
            .precision = "double",
            .ladder = Ladder::substeps,
            .value = 4,
            .collider = "reference",
            .contacts = "shared",
            .settings = {"precision=double", substeps}};
}

/// A rod on a joint as any scene: its error against a finer run is that against the formula.
TEST(SelfReference, TellsTheErrorThatTheFormulaTells) {
    Subject known = find_case("pendulum")->make();
    known.scene.settings.duration = 1;
    const Subject blind =
        self_referenced(known.scene, "blind", colliders(), {.seconds = 30, .stop = {}});
    EXPECT_EQ(blind.metrics.front().name, "pose");
    const Point p = point_at("blind", "substeps=4");
    const Outcome formula = run_point(known, p, colliders(), true, {});
    const Outcome reference = run_point(blind, p, colliders(), true, {});
    ASSERT_EQ(reference.status, study::Status::done) << reference.note;
    const double radius = 0.5;  // from the joint to the centre [m]
    EXPECT_NEAR(reference.errors[0], radius * formula.errors[0], 0.1 * reference.errors[0]);
    EXPECT_LT(blind.metrics.front().reference_error, 0.1 * reference.errors[0]);
}

/// Three rods on ball joints that fall and whip.
Scene whip() {
    Scene scene;
    scene.name = "whip";
    scene.settings.duration = 1.5;
    scene.settings.forbid = {"contacts"};
    for (int i = 0; i < 3; ++i) {
        add_body(scene, box(0.2, 0.01, 0.01), {0.2 + 0.4 * i, 0, 0}).mass = 1;
        const std::uint32_t before = i > 0 ? static_cast<std::uint32_t>(i - 1) : kNoIndex;
        add_joint(scene, JointKind::ball, static_cast<std::uint32_t>(i), before, {0.4 * i, 0, 0});
    }
    return scene;
}

/// The settings of a reference of so many substeps, which must divide by eight.
Point reference_point(const char* subject, const Scene& scene, std::uint32_t substeps) {
    Point p = point_at(subject, "leapfrog_start=true");
    p.settings.push_back("dt=" + std::to_string(scene.settings.dt / 8));
    p.settings.push_back("substeps=" + std::to_string(substeps / 8));
    return p;
}

/// What a reference says of its own error is no less than how far a much finer one is from it.
TEST(SelfReference, KnowsItsOwnError) {
    Scene pendulum = find_case("pendulum")->make().scene;
    pendulum.settings.duration = 1;
    for (const Scene& scene : {pendulum, whip()}) {
        const ReferenceOptions fine{.substeps = 2048, .error = 1};
        const Subject truth = self_referenced(scene, "truth", colliders(), fine);
        for (const std::uint32_t substeps : {8u, 24u, 64u, 200u}) {
            const ReferenceOptions coarse{.substeps = substeps, .error = 1};
            const Subject reference = self_referenced(scene, "coarse", colliders(), coarse);
            const Point p = reference_point("truth", scene, substeps);
            const Outcome outcome = run_point(truth, p, colliders(), true, {});
            ASSERT_EQ(outcome.status, study::Status::done) << outcome.note;
            EXPECT_LE(outcome.errors[0], reference.metrics[0].reference_error)
                << scene.name << " at " << substeps;
        }
    }
}

/// The rods fall to the ground: few iterations to an impact leave the same of it, however short the
/// substeps are, and references that all had those few would agree on what is wrong.
TEST(SelfReference, IteratesImpactsToTheirEnd) {
    Scene scene = whip();
    scene.settings.forbid = {};
    scene.settings.duration = 0.4;
    add_ground(scene).placement.position = {0, -0.25, 0};
    const Subject reference =
        self_referenced(scene, "landing", colliders(), {.substeps = 256, .error = 1});
    Point p = point_at("landing", "leapfrog_start=true");
    p.settings.push_back("dt=" + std::to_string(scene.settings.dt / 100));
    p.settings.push_back("substeps=4");
    p.settings.push_back("velocity_iterations=200");
    p.settings.push_back("position_iterations=200");
    const Outcome outcome = run_point(reference, p, colliders(), true, {});
    ASSERT_EQ(outcome.status, study::Status::done) << outcome.note;
    EXPECT_LE(outcome.errors[0], reference.metrics[0].reference_error);
    EXPECT_LT(reference.metrics[0].reference_error, 1e-5);
}

/// References are no finer than what is asked of them.
TEST(SelfReference, EndsWhereItIsKnownWell) {
    std::uint32_t before = 0;
    for (const double error : {1e-2, 1e-4, 1e-6}) {
        const Subject s = self_referenced(whip(), "whip", colliders(), {.error = error});
        EXPECT_LE(s.metrics[0].reference_error, 0.15 * error);
        EXPECT_EQ(s.horizon, 0) << "poses are compared to the end";
        EXPECT_GT(s.reference_substeps, before);
        before = s.reference_substeps;
    }
}

/// Rods that whirl for a minute part from any reference long before: neither references nor runs
/// go on for much longer than poses can be compared.
TEST(SelfReference, RunsNoFartherThanPredictionGoes) {
    Scene scene = whip();
    scene.settings.duration = 60;
    const Subject s = self_referenced(scene, "whip", colliders(), {.seconds = 2, .error = 1e-3});
    EXPECT_GT(s.horizon, 0);
    EXPECT_LE(s.horizon, s.scene.settings.duration);
    EXPECT_LT(s.scene.settings.duration, 60);
    EXPECT_NE(s.reference.find("of the first"), std::string::npos) << s.reference;
    const Outcome outcome =
        run_point(s, point_at("whip", "leapfrog_start=true"), colliders(), true, {});
    EXPECT_EQ(outcome.status, study::Status::done) << outcome.note;
}

/// A ball in a held sheet: what deforms has its share in poses and figures of its own, and finer
/// runs are nearer.
TEST(SelfReference, TellsTheErrorOfWhatDeforms) {
    Scene scene;
    scene.settings.duration = 0.2;
    DeformableSpec& cloth = add_soft(scene, sheet({4, 4}, {1, 1}));
    cloth.mass = 1, cloth.elasticity.youngs_modulus = 1e4;
    hold(scene, 0, {0, 4, 20, 24});
    add_soft(scene, balloon(0.1, 2, {0, 0.5, 0})).mass = 0.1;
    const Subject subject =
        self_referenced(scene, "soft", colliders(), {.substeps = 256, .stop = {}});
    std::vector<std::string> names;
    for (const Metric& m : subject.metrics) names.push_back(m.name);
    EXPECT_EQ(names.front(), "pose");
    for (const char* name : {"energy", "momentum", "strain", "volume"})
        EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    std::vector<double> before;
    for (const char* substeps : {"substeps=4", "substeps=32"}) {
        const Point p = point_at("soft", substeps);
        const Outcome outcome = run_point(subject, p, colliders(), true, {});
        ASSERT_EQ(outcome.status, study::Status::done) << outcome.note;
        EXPECT_GT(outcome.errors[0], 0);
        for (std::size_t i = 0; i < before.size(); ++i)
            EXPECT_LT(outcome.errors[i], before[i]) << names[i];
        before = {outcome.errors.begin(), outcome.errors.begin() + 5};
    }
}

/// The pendulum divides steps that are too long for it, so that longer ones cost as much and are as
/// exact.
bool takes_whole_steps(const Trial& trial) {
    return trial.point.settings_text().find("substeps=1 ") != std::string::npos;
}

/// The error with half of the substeps.
double error_of_coarser(const Subject& subject, const Trial& trial) {
    Point p = trial.point;
    const std::string key = "substeps=";
    for (std::string& setting : p.settings)
        if (setting.starts_with(key))
            setting = key + std::to_string(std::stoi(setting.substr(key.size())) / 2);
    return run_point(subject, p, colliders(), true, {}).errors[0];
}

TEST(Tune, ReachesAnErrorWithFewRuns) {
    const Subject subject = find_case("pendulum")->make();
    for (const double error : {0.02, 3e-3, 1.2e-3, 4e-4, 1e-4}) {
        TuneOptions options;
        options.error = error;
        const TuneResult result = tune(subject, colliders(), options);
        ASSERT_TRUE(result.best) << error;
        EXPECT_LE(result.best->error(), error);
        const auto is_just_fine_enough = [&](const Trial& trial) {
            return trial.error() <= error &&
                   (trial.error() > error / 4 || takes_whole_steps(trial) ||
                    error_of_coarser(subject, trial) > error);
        };
        EXPECT_TRUE(std::ranges::any_of(result.trials, is_just_fine_enough))
            << "nothing but finer than need be was tried for " << error;
        EXPECT_LE(result.trials.size() + 1, 15u);
    }
}

/// The wanted error holds against a reference that is ten times finer than the one it was tuned on.
TEST(Tune, HoldsAgainstAFinerReference) {
    for (const double error : {0.04, 0.01, 1.5e-3}) {
        const Subject subject = self_referenced(whip(), "whip", colliders(), {.error = error});
        TuneOptions options;
        options.error = error;
        const TuneResult result = tune(subject, colliders(), options);
        ASSERT_TRUE(result.best) << error;
        const ReferenceOptions ten{.substeps = 10 * subject.reference_substeps, .error = error};
        const Subject finer = self_referenced(whip(), "whip", colliders(), ten);
        const Outcome outcome = run_point(finer, result.best->point, colliders(), true, {});
        ASSERT_EQ(outcome.status, study::Status::done) << outcome.note;
        EXPECT_LE(outcome.errors[0], error);
    }
}

TEST(Tune, TriesRawContactsAndOtherCollidersUnlessOneIsAskedFor) {
    Scene heap;
    heap.settings.duration = 0.2;
    add_ground(heap);
    for (int i = 0; i < 4; ++i) add_body(heap, cylinder(0.2, 0.05), {0.02 * i, 0.05 + 0.1 * i, 0});
    const Subject subject = self_referenced(heap, "heap", colliders(), {.error = 0.05});
    for (const bool asked : {false, true}) {
        TuneOptions options;
        options.error = 0.05;
        options.detections = 0;
        if (asked) options.collider = "ode";
        const TuneResult result = tune(subject, colliders(), options);
        ASSERT_TRUE(result.best);
        EXPECT_LE(result.best->error(), options.error);
        EXPECT_LE(result.trials.size() + 1, 15u);
        const auto is_raw = [](const Trial& t) { return t.point.contacts == "raw"; };
        const auto is_on_ode = [](const Trial& t) { return t.point.collider == "ode"; };
        EXPECT_TRUE(std::ranges::any_of(result.trials, is_raw));
        EXPECT_TRUE(std::ranges::any_of(result.trials, is_on_ode));
        EXPECT_EQ(std::ranges::all_of(result.trials, is_on_ode), asked);
    }
}

TEST(Tune, SaysWhereItDoesNotGetThere) {
    TuneOptions options;
    options.error = 1e-300;
    EXPECT_FALSE(tune(find_case("pendulum")->make(), colliders(), options).best);
}

TEST(Tune, EndsWhenItsTimeIsOver) {
    TuneOptions options;
    options.error = 1e-300;
    options.seconds = 0;
    const TuneResult result = tune(find_case("pendulum")->make(), colliders(), options);
    EXPECT_FALSE(result.best);
    EXPECT_TRUE(result.ran_out);
    EXPECT_TRUE(result.trials.empty());
}

}  // namespace
}  // namespace plumb::test
