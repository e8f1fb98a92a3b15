// SPDX-License-Identifier: MIT
/// plumb tune: the cheapest settings of a scene that reach an error.
#include "study/tune.h"
#include "app/interrupt.h"
#include "app/plugin_path.h"
#include "app/progress.h"
#include "app/study_options.h"
#include "app/usage.h"
#include "app/verbs.h"
#include "host/log.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>

namespace plumb::app {
namespace {

struct TuneArguments {
    std::string subject, collider = "auto", metric, budget = "4m", plugin_path;
    double error = 0, time = 0;
    std::uint32_t reference = 0;
    bool quiet = false;
};

void check(const TuneArguments& o) {
    if (o.error > 0 || o.time > 0) return;
    throw UsageError("--error or --time is required; write --error 0.001");
}

/// Of the budget, what the references of a scene may take; they end where they are known well.
constexpr double kForReferences = 0.5;

/// A reference that is itself less exact than what is asked for cannot tell.
void check_reach(const TuneArguments& o, const study::Subject& subject) {
    constexpr double kMargin = 2;
    const double known = subject.metrics.front().reference_error;
    if (!(o.error > 0) || o.error >= kMargin * known) return;
    char text[240];
    std::snprintf(text, sizeof text,
                  "--error %g: the references that --budget %s allows are only known to %.2g %s; "
                  "ask for at least %.2g, or give them more time",
                  o.error, o.budget.c_str(), known, subject.metrics.front().unit.c_str(),
                  kMargin * known);
    throw UsageError(text);
}

/// key=value as a line of JSON.
std::string json_line(const std::string& setting) {
    const std::size_t equals = setting.find('=');
    const std::string key = setting.substr(0, equals), value = setting.substr(equals + 1);
    const bool is_bare = value == "true" || value == "false" ||
                         value.find_first_not_of("0123456789.e+-") == std::string::npos;
    const std::string text = is_bare ? value : "\"" + value + "\"";
    return "  \"" + key + "\": " + text;
}

void print_trials(const study::Subject& subject, const study::TuneResult& result) {
    const std::string unit = subject.metrics.front().unit;
    std::fprintf(stderr, "%12s %14s  settings\n",
                 (subject.metrics.front().name + (unit.empty() ? "" : " [" + unit + "]")).c_str(),
                 "µs/s");
    for (const study::Trial& t : result.trials) {
        if (t.is_done())
            std::fprintf(stderr, "%12.3g %14.0f  ", t.error(), t.outcome.cost.total);
        else
            std::fprintf(stderr, "%12s %14s  ", std::string(name_of(t.outcome.status)).c_str(),
                         "-");
        std::fprintf(stderr, "%s on %s\n", t.point.settings_text().c_str(),
                     t.point.collider.c_str());
    }
}

/// Behind a number.
std::string unit_of(const study::Metric& metric) {
    return metric.unit.empty() ? "" : " " + metric.unit;
}

/// Whether poses are compared for as long as they can be predicted, and not all along.
bool has_horizon(const study::Subject& subject) {
    return subject.metrics.front().name == "pose" && subject.horizon > 0;
}

/// How long they are compared then, behind an error.
std::string until(const study::Subject& subject) {
    if (!has_horizon(subject)) return "";
    char text[60];
    std::snprintf(text, sizeof text, " in the first %.3g s", subject.horizon);
    return text;
}

/// What the error is against, and how well that is known.
void print_reference(const study::Subject& subject) {
    if (subject.reference_substeps == 0) return;
    const study::Metric& metric = subject.metrics.front();
    logger()->info("against {}, which is itself known to {:.2g}{}; that counts as error",
                   subject.reference, metric.reference_error, unit_of(metric));
    if (has_horizon(subject))
        logger()->warn(
            "poses are compared for {:.3g} s, as long as they can be predicted, and runs take "
            "{:.3g} "
            "s: ask for a larger error, or give more time, to have them compared for longer",
            subject.horizon, subject.scene.settings.duration);
}

/// Says why there are no such settings, and returns the exit code.
int not_reached(const TuneArguments& o, const study::Subject& subject,
                const study::TuneResult& result) {
    if (interrupted()) return kInterrupted;
    const std::string over =
        result.ran_out ? "the budget of " + o.budget + " was over before all was tried; " : "";
    const study::Trial *exact = nullptr, *cheap = nullptr, *failed = nullptr;
    for (const study::Trial& t : result.trials) {
        if (!t.is_done()) {
            failed = &t;
            continue;
        }
        if (!exact || t.error() < exact->error()) exact = &t;
        if (!cheap || t.outcome.cost.total < cheap->outcome.cost.total) cheap = &t;
    }
    const std::string unit = unit_of(subject.metrics.front());
    if (!exact && result.ran_out) {
        logger()->error("{}no run ended", over);
        return kUsage;
    }
    if (!exact) {
        const bool refused = failed && failed->outcome.status == study::Status::refused;
        logger()->error("{} {} at all settings that were tried: {}", subject.name,
                        refused ? "is refused" : "diverges", failed ? failed->outcome.note : "");
        return refused ? kColliderUnable : kDiverged;
    }
    if (o.time > 0)
        logger()->error(
            "{}no settings were found within {:g} µs a simulated second that reach it; the "
            "cheapest took {:.0f} µs, the most exact left {:.3g}{}",
            over, o.time, cheap->outcome.cost.total, exact->error(), unit);
    else
        logger()->error("{}no settings were found that reach it; the least error was {:.3g}{}",
                        over, exact->error(), unit);
    print_reference(subject);
    return kUsage;
}

int tune(const TuneArguments& o) {
    check(o);
    const double seconds = seconds_of(o.budget, "--budget");
    const ColliderLibrary colliders(o.plugin_path);
    catch_interrupts();
    const auto began = std::chrono::steady_clock::now();
    study::ReferenceOptions references;
    references.collider = o.collider;
    references.seconds = kForReferences * seconds;
    references.substeps = o.reference;
    references.error = o.error;
    references.metric = o.metric;
    references.stop = interrupted;
    study::Subject subject = subject_named(o.subject, colliders, references);
    if (!o.metric.empty()) choose_metric(subject, o.metric);
    check_reach(o, subject);

    study::TuneOptions options;
    options.error = o.error;
    if (o.time > 0) options.time = o.time;
    options.collider = o.collider;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
    options.seconds = std::max(seconds - spent.count(), 0.0);
    options.stop = interrupted;
    study::TuneResult result;
    {
        Progress progress(options.most_runs, o.quiet);
        options.progress = [&](std::uint32_t run, std::uint32_t most, const study::Point& p) {
            progress.show_runs(run, most, p.settings_text());
        };
        result = study::tune(subject, colliders, options);
    }
    if (!o.quiet && logger()->should_log(spdlog::level::info)) print_trials(subject, result);
    if (!result.best) return not_reached(o, subject, result);
    const study::Trial& best = *result.best;
    std::printf("\"settings\": {\n");
    for (std::size_t i = 0; i < best.point.settings.size(); ++i)
        std::printf("%s%s\n", json_line(best.point.settings[i]).c_str(),
                    i + 1 < best.point.settings.size() ? "," : "");
    std::printf("}\n");
    const study::Metric& metric = subject.metrics.front();
    logger()->info("{}: {} is {:.3g}{}{} at {:.0f} µs of CPU a simulated second, in {} runs",
                   subject.name, metric.what, best.error(), unit_of(metric), until(subject),
                   best.outcome.cost.total, result.trials.size() + 1);
    logger()->info("add these to the scene's settings, and run it with --collider {}",
                   best.point.collider);
    print_reference(subject);
    return kDone;
}

}  // namespace

Verb add_tune(CLI::App& command) {
    auto o = std::make_shared<TuneArguments>();
    command.add_option("subject", o->subject, "a scene's file, or a case by name")
        ->required()
        ->type_name("SCENE|CASE");
    command.add_option("--error", o->error, "wanted, in the unit of the metric")
        ->check(CLI::PositiveNumber)
        ->type_name("E");
    command
        .add_option("--time", o->time,
                    "CPU time allowed [µs a simulated second]; alone: the least error within it")
        ->check(CLI::PositiveNumber)
        ->type_name("T");
    command.add_option("--metric", o->metric, "what is taken as the error")->type_name("NAME");
    command
        .add_option("--collider", o->collider,
                    "collision plugin; auto = the cheapest that can do the scene")
        ->type_name("NAME");
    command
        .add_option(
            "--reference", o->reference,
            "substeps of a scene's reference to one of its steps; as many as tell the error, "
            "or as half of the budget allows, unless told")
        ->check(CLI::Range(8u, 1u << 20))
        ->type_name("N");
    command
        .add_option("--budget", o->budget,
                    "time for all runs, of which the references of a scene may take half; "
                    "4m unless told")
        ->type_name("TIME");
    command.add_flag("--quiet", o->quiet, "no progress bar, no table of runs");
    add_plugin_path_option(command, o->plugin_path);
    return [o] { return with_references([&] { return tune(*o); }); };
}

}  // namespace plumb::app
