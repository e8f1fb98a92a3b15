// SPDX-License-Identifier: MIT
/// plumb cost: what accuracy costs in time, of cases with known answers and of any scene.
#include "app/interrupt.h"
#include "app/plugin_path.h"
#include "app/progress.h"
#include "app/study_files.h"
#include "app/study_options.h"
#include "app/usage.h"
#include "app/verbs.h"
#include "host/log.h"
#include "output/error.h"
#include "scene/error.h"
#include "scene/nearest.h"
#include "study/cases.h"
#include "study/findings.h"
#include "study/journal.h"
#include "study/self_reference.h"
#include "study/sweep.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

namespace plumb::app {
namespace {

/// Of the budget, what the references of scenes without a formula may take.
constexpr double kForReferences = 0.25;

struct CostArguments {
    std::vector<std::string> subjects, colliders, curves, merge;
    std::string out, plugin_path, budget = "5m", shard = "1/1", metric;
    std::uint32_t repeats = 5, reference = 0;
    bool list = false, quiet = false;
};

struct Shard {
    std::uint32_t number = 1, of = 1;
};

Shard shard_of(const std::string& text) {
    constexpr std::uint32_t kMost = 100000;
    Shard s;
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, s.number);
    const bool divided = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
    const auto of = std::from_chars(divided ? number.ptr + 1 : end, end, s.of);
    if (!divided || of.ec != std::errc() || of.ptr != end || s.number < 1 || s.number > s.of ||
        s.of > kMost)
        throw UsageError("--shard " + text + ": must be I/N with 1 ≤ I ≤ N, such as 2/4");
    return s;
}

void check(const CostArguments& o) {
    if (o.out.empty()) throw UsageError("--out is required; name a folder for the report");
    if (!o.merge.empty() && !o.subjects.empty())
        throw UsageError("--merge takes its cases from the folders; name none beside it");
    const std::set<std::string> colliders(o.colliders.begin(), o.colliders.end());
    if (colliders.size() < o.colliders.size()) throw UsageError("--colliders names one twice");
    const std::set<std::string> distinct(o.subjects.begin(), o.subjects.end());
    if (distinct.size() < o.subjects.size()) throw UsageError("a case or scene is named twice");
    for (const std::string& curve : o.curves) {
        std::vector<std::string> names = study::curve_names();
        if (std::find(names.begin(), names.end(), curve) == names.end())
            throw UsageError("--curves " + curve + ": there is no such curve" +
                             advice(curve, names));
    }
}

int list_cases() {
    for (const study::CaseEntry& c : study::cases())
        std::printf("%-18s %s\n", std::string(c.name).c_str(), c.make().title.c_str());
    return kDone;
}

std::vector<study::Subject> subjects_of(const CostArguments& o, const ColliderLibrary& colliders,
                                        double seconds) {
    std::vector<std::string> names = o.subjects;
    if (names.empty())
        for (const study::CaseEntry& c : study::cases()) names.emplace_back(c.name);
    const auto before = study::plan_in(o.out);  // a sweep that is gone on with keeps its references
    std::vector<study::Subject> subjects;
    for (const std::string& name : names) {
        const std::string called = std::filesystem::path(name).stem().string();
        for (const study::Subject& s : subjects)
            if (s.name == called)
                throw UsageError(name + ": another one is called \"" + called +
                                 "\", too; rename a file");
        const study::SubjectSummary* known = before ? before->find(called) : nullptr;
        try {
            study::ReferenceOptions references;
            if (!o.colliders.empty()) references.collider = o.colliders.front();
            references.seconds = seconds / static_cast<double>(names.size());
            references.substeps = known ? known->reference_substeps : o.reference;
            references.stop = interrupted;
            subjects.push_back(subject_named(name, colliders, references));
        } catch (const study::NoReference& e) {
            if (e.reason == study::NoReference::stopped || names.size() == 1) throw;
            logger()->warn("left out: {}", e.what());
            continue;
        }
        if (!o.metric.empty()) choose_metric(subjects.back(), o.metric);
    }
    if (subjects.empty()) throw UsageError("no scene is left to be measured");
    return subjects;
}

/// What a person wants to know, on stdout. Points of other parts are not missed.
void print_findings(const study::StudyTable& table, const Shard& shard) {
    std::size_t ran = 0, failed = 0, left = 0, of_others = 0;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const study::Status status = table.rows[i].status;
        ran += status == study::Status::done;
        failed += status == study::Status::diverged || status == study::Status::refused;
        if (status == study::Status::not_run)
            ++(i % shard.of == shard.number - 1 ? left : of_others);
    }
    for (const study::SubjectSummary& s : table.subjects) {
        std::printf("%s: %s\n", s.name.c_str(), s.title.c_str());
        const auto sentences = study::advice_on(table, s);
        for (const std::string& sentence : sentences) std::printf("  %s\n", sentence.c_str());
        if (sentences.empty()) std::printf("  no settings gave a result\n");
    }
    std::printf("%zu points ran, %zu failed, %zu were not run", ran, failed, left);
    if (of_others > 0) std::printf("; %zu are for other parts", of_others);
    std::printf("\n");
}

/// Writes what came of it, and tells it.
int finish(const CostArguments& o, const study::StudyTable& table, const Shard& shard) {
    const std::vector<std::string> remarks = write_study(table, o.out);
    print_findings(table, shard);
    for (const std::string& remark : remarks) logger()->warn(remark);
    if (interrupted()) return kInterrupted;
    const study::Row* refused = nullptr;
    bool diverged = false;
    for (const study::Row& r : table.rows) {
        if (r.status == study::Status::done) return kDone;
        diverged |= r.status == study::Status::diverged;
        if (r.status == study::Status::refused) refused = &r;
    }
    if (diverged) {
        logger()->error("every point that was run diverged");
        return kDiverged;
    }
    if (refused) {
        logger()->error("every point is refused: {}", refused->note);
        return kColliderUnable;
    }
    logger()->error("the budget of {} was too small for a single point", o.budget);
    return kUsage;
}

int measure(const CostArguments& o) {
    const auto start = std::chrono::steady_clock::now();
    const double budget = seconds_of(o.budget, "--budget");
    const Shard shard = shard_of(o.shard);
    const ColliderLibrary colliders(o.plugin_path);
    catch_interrupts();
    const std::vector<study::Subject> subjects = subjects_of(o, colliders, kForReferences * budget);
    study::StudyTable table = study::plan_sweep(subjects, {o.colliders, o.curves}, colliders);
    if (table.rows.empty())
        throw UsageError("--curves: nothing of these is called for by what is to be swept");
    if (shard.number > table.rows.size())
        throw UsageError("--shard " + o.shard + ": there are only " +
                         std::to_string(table.rows.size()) + " points");
    for (const std::string& name : o.colliders)
        if (std::none_of(table.rows.begin(), table.rows.end(),
                         [&](const study::Row& r) { return r.point.collider == name; }))
            logger()->warn("--colliders {}: left out, since no curve of this sweep calls for it",
                           name);
    study::Journal journal(o.out, table);

    Progress progress(table.rows.size(), o.quiet);
    study::SweepOptions options;
    options.budget =
        budget - std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    options.repeats = o.repeats;
    options.shard = shard.number;
    options.of = shard.of;
    options.interrupted = interrupted;
    options.ran = [&](std::size_t row, bool judged, const study::Outcome& outcome) {
        journal.add(row, judged, outcome);
    };
    options.progress = [&](const study::SweepProgress& p) {
        progress.show_runs(p.done, p.all, p.next->point.subject + ": " + p.next->point.curve);
    };
    study::sweep(table, subjects, colliders, options);
    return finish(o, table, shard);
}

int cost(const CostArguments& o) {
    if (o.list) return list_cases();
    check(o);
    if (o.merge.empty()) return measure(o);
    const bool is_part = std::find(o.merge.begin(), o.merge.end(), o.out) != o.merge.end();
    if (!is_part && study::plan_in(o.out))
        throw OutputError(o.out, "holds another sweep; name another folder");
    return finish(o, study::merged(o.merge), {});
}

}  // namespace

Verb add_cost(CLI::App& command) {
    auto o = std::make_shared<CostArguments>();
    command
        .add_option("subjects", o->subjects,
                    "cases by name (--list), scenes by file; all cases unless named")
        ->type_name("SCENE|CASE");
    command.add_option("--out", o->out, "folder for the tables, the charts and the report")
        ->type_name("DIR");
    command.add_option("--budget", o->budget, "time for all runs; 5m unless told")
        ->type_name("TIME");
    command.add_option("--metric", o->metric, "what is charted as the error")->type_name("NAME");
    command
        .add_option("--colliders", o->colliders,
                    "run on these, separated by ','; most curves on the first")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("NAMES");
    command.add_option("--curves", o->curves, "only these curves, separated by ','")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("NAMES");
    command.add_option("--repeats", o->repeats, "runs of each point for its time; 5 unless told")
        ->check(CLI::Range(1u, 1000u))
        ->type_name("N");
    command.add_option("--shard", o->shard, "run only the I-th of N parts of the plan")
        ->type_name("I/N");
    CLI::Option* merge =
        command.add_option("--merge", o->merge, "make one report of the folders of several parts")
            ->type_name("DIR");
    command
        .add_option("--reference", o->reference,
                    "substeps of a scene's reference to one of its steps; as many as a quarter of "
                    "the budget allows unless told. Parts on several machines need the same")
        ->check(CLI::Range(8u, 1u << 20))
        ->type_name("N");
    for (const char* of_a_sweep :
         {"--budget", "--metric", "--colliders", "--curves", "--repeats", "--shard", "--reference"})
        merge->excludes(command.get_option(of_a_sweep));
    command.add_flag("--list", o->list, "name the cases");
    command.add_flag("--quiet", o->quiet, "no progress bar");
    add_plugin_path_option(command, o->plugin_path);
    return [o] { return with_references([&] { return cost(*o); }); };
}

}  // namespace plumb::app
