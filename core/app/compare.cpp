// SPDX-License-Identifier: MIT
/// plumb compare: the contact sets of several colliders, measured against each other on the same
/// poses.
#include "app/comparison_json.h"
#include "app/comparison_text.h"
#include "app/contact_sources.h"
#include "app/distinct_files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/usage.h"
#include "app/verbs.h"
#include "host/log.h"
#include "output/comparison_page.h"
#include "output/file.h"
#include "scene/error.h"
#include "scene/nearest.h"
#include "study/comparison.h"
#include "study/comparison_rows.h"
#include "study/free_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

namespace plumb::app {
namespace {

struct CompareArguments {
    RunOptions run;
    std::vector<std::string> colliders;
    std::string drive, answer_only, json, page;
    std::uint64_t every = 1;
    bool isolate = false, quiet = false, free_run = false, judge_raw = false;
};

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

/// What the command line alone can tell.
void check(const CompareArguments& o) {
    const std::string ending = std::filesystem::path(o.page).extension().string();
    if (!o.page.empty() && ending != ".html")
        throw UsageError("--out " + o.page + ": a comparison is written to a .html file");
    check_distinct({o.page, o.json}, o.run.scene);
    const std::set<std::string> distinct(o.colliders.begin(), o.colliders.end());
    if (o.colliders.empty())
        throw UsageError("--colliders is required; write --colliders ode,bullet");
    if (o.colliders.size() < 2) throw UsageError("--colliders names one collider; two are needed");
    if (distinct.size() < o.colliders.size())
        throw UsageError("--colliders " + listed(o.colliders) + ": names a collider twice");
    if (!o.drive.empty() && !distinct.contains(o.drive))
        throw UsageError("--drive " + o.drive + ": is none of the colliders that are compared (" +
                         listed(o.colliders) + ")" + advice(o.drive, o.colliders));
}

/// The shapes that the findings need drawn; nullptr for all others.
std::vector<const Geometry*> drawn_shapes(const Scene& scene,
                                          const study::ComparisonResult& result) {
    std::vector<const Geometry*> shapes(scene.geometries.size());
    for (const study::Finding& f : study::findings_of(result))
        for (const std::uint32_t body : {f.disagreement.a, f.disagreement.b}) {
            const std::uint32_t geometry = scene.bodies[body].geometry;
            shapes[geometry] = &scene.geometries[geometry];
        }
    return shapes;
}

void write(std::optional<WholeFile>& file, const std::string& text) {
    if (!file) return;
    file->append(text);
    file->commit();
}

/// Opens what shall be written before the comparison runs.
std::optional<WholeFile> opened(const std::string& path) {
    if (path.empty() || path == "-") return std::nullopt;
    return std::optional<WholeFile>(std::in_place, path);
}

/// All that a comparison needs, made before it runs.
struct Prepared {
    RunOptions run;
    Scene scene;
    ColliderLibrary colliders;
    std::unique_ptr<Simulation> simulation;
    Sources sources;
    std::size_t driver;

    explicit Prepared(const CompareArguments& o)
        : run(driven_by(o)),
          scene(load_scene(run)),
          colliders(run.plugin_path),
          simulation(start(scene, colliders, run)),
          sources(make_sources({o.colliders, run.collider, o.isolate}, scene, colliders, run)),
          driver(static_cast<std::size_t>(
              std::find(o.colliders.begin(), o.colliders.end(), run.collider) -
              o.colliders.begin())) {}

    static RunOptions driven_by(const CompareArguments& o) {
        RunOptions run = o.run;
        run.collider = o.drive.empty() ? o.colliders.front() : o.drive;
        return run;
    }
};

study::ComparisonResult compared(const CompareArguments& o, Prepared& p, std::uint64_t steps) {
    Progress progress(steps, o.quiet);
    return study::compare_colliders(
        {p.scene, p.sources.all, p.sources.own_process, p.driver, o.every, o.judge_raw},
        *p.simulation, [&](std::uint64_t step, std::uint32_t contacts, bool agree) {
            progress.show(step, contacts, agree ? "all agree so far" : "they differ");
            return !interrupted();
        });
}

std::optional<study::FreeRuns> run_freely(const CompareArguments& o, Prepared& p,
                                          std::uint64_t steps) {
    if (!o.free_run || interrupted()) return std::nullopt;
    Progress progress(steps, o.quiet);
    return study::free_runs(p.scene, p.colliders, p.sources.all, p.sources.own_process,
                            [&](std::uint64_t step, std::uint32_t contacts) {
                                progress.show(step, contacts, "free runs");
                                return !interrupted();
                            });
}

/// Which runs diverged, as one sentence; "" where none did.
std::string divergence(const study::ComparisonResult& result, const study::FreeRuns* runs) {
    std::string text;
    const auto add = [&](const std::string& run, std::uint64_t step) {
        if (step == 0) return;
        text += (text.empty() ? "diverged: " : "; ") + run + " is no longer finite after step " +
                std::to_string(step);
    };
    add("the run that " + result.colliders[result.driver].info.name + " drives",
        result.diverged_after);
    for (std::size_t i = 0; runs && i < result.colliders.size(); ++i)
        add("the free run of " + result.colliders[i].info.name, runs->diverged_after[i]);
    return text;
}

/// Says how the comparison ended where that was not as planned, and returns the exit code.
int exit_code(const study::ComparisonResult& result, const study::FreeRuns* runs) {
    const std::string diverged = divergence(result, runs);
    if (!diverged.empty()) logger()->error(diverged);
    if (interrupted()) return kInterrupted;
    if (!diverged.empty()) return kDiverged;
    return result.agrees() ? kDone : kDiffer;
}

int compare(const CompareArguments& o) {
    check(o);
    Prepared p(o);
    std::optional<WholeFile> json_file = opened(o.json), page_file = opened(o.page);
    const std::uint64_t steps = step_count(p.scene.settings);

    catch_interrupts();
    const study::ComparisonResult result = compared(o, p, steps);
    const std::optional<study::FreeRuns> runs = run_freely(o, p, steps);

    auto json = comparison_json(p.scene, p.simulation->world().bodies, result);
    if (runs) json["free_run"] = free_runs_json(result, *runs);
    const std::string json_text =
        json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    const std::string text =
        o.json == "-" ? json_text : comparison_text(p.scene, result, runs ? &*runs : nullptr);
    std::fputs(text.c_str(), stdout);
    write(json_file, json_text);
    if (page_file)
        write(page_file, comparison_page(p.scene.name, json_text, drawn_shapes(p.scene, result)));
    return exit_code(result, runs ? &*runs : nullptr);
}

}  // namespace

Verb add_compare(CLI::App& command) {
    auto o = std::make_shared<CompareArguments>();
    add_scene_options_but_collider(command, o->run);
    command
        .add_option("--colliders", o->colliders,
                    "the collision plugins, two or more, separated by ','")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("NAMES");
    command
        .add_option("--drive", o->drive,
                    "the one of them that steps the scene; the first unless told")
        ->type_name("NAME");
    command.add_option("--every", o->every, "compare every Nth step; 1 unless told")
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40));
    command.add_flag("--judge-raw", o->judge_raw,
                     "what the back-ends themselves say (raw) must agree, too");
    command.add_flag("--isolate", o->isolate,
                     "run every collider but the driving one in a process of its own");
    command
        .add_option("--json", o->json,
                    "write the comparison as JSON to a file, or to stdout (-) in place of the text")
        ->type_name("FILE");
    command
        .add_option(
            "--out", o->page,
            "write a page with the tables and the worst disagreements drawn to a .html file")
        ->type_name("FILE");
    command.add_flag(
        "--free-run", o->free_run,
        "also let each collider drive a run of its own, and show how they drift apart");
    command.add_flag("--quiet", o->quiet, "no progress bar");
    command.add_option("--answer-only", o->answer_only, "")->group("");
    return [o] {
        if (o->answer_only.empty()) return compare(*o);
        answer_only(o->answer_only, o->run);
        return static_cast<int>(kDone);
    };
}

}  // namespace plumb::app
