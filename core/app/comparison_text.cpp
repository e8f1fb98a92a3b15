// SPDX-License-Identifier: MIT
#include "app/comparison_text.h"

#include "measure/measure.h"
#include "study/comparison_rows.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <tuple>

namespace plumb::app {
namespace {

constexpr std::size_t kListed = 2, kListedRaw = 1;  // of each aspect of a pair of colliders

template <class... Args>
std::string printed(const char* format, Args... args) {
    char text[2000];
    std::snprintf(text, sizeof text, format, args...);
    return text;
}

/// Fills a cell of so many columns; a letter may be several bytes long.
std::string cell(const std::string& text, int width, bool right = true) {
    int letters = 0;
    for (const char c : text) letters += (c & 0xc0) != 0x80;
    const std::string space(static_cast<std::size_t>(std::max(0, width - letters)), ' ');
    return right ? space + text : text + space;
}

/// Never rounds up to 100 %.
std::string percent(double share) {
    if (share >= 1) return "100 %";
    const double shown = std::min(100 * share, 99.9999);
    return printed(shown > 99.99 ? "%.4f %%" : "%.2f %%", shown);
}

std::string share_of(std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? percent(static_cast<double>(part) / static_cast<double>(whole)) : "–";
}

double own_normals(const study::AnswerFigures& f) {
    return f.contacts > 0
               ? 1 - static_cast<double>(f.sum.shared_normals) / static_cast<double>(f.contacts)
               : 1;
}

std::string collider_table(const study::ComparisonResult& r) {
    std::string text = cell("collider", 14, false) + cell("version", 18, false) +
                       cell("ms a pose", 10) + cell("raw ms", 9) + cell("contacts", 10) +
                       cell("back-end", 10) + cell("clip", 10) + cell("fallback", 10) +
                       cell("own normals", 13) + "\n";
    for (const study::ColliderFigures& c : r.colliders) {
        const DetectStats& s = c.clipped.sum;
        const double poses = static_cast<double>(std::max<std::uint64_t>(1, r.poses));
        text += cell(c.info.name + (c.own_process ? " *" : ""), 14, false) +
                cell(c.info.version, 18, false) +
                cell(printed("%.3f", percentile(c.clipped.milliseconds, 0.5)), 10) +
                cell(printed("%.3f", percentile(c.raw.milliseconds, 0.5)), 9) +
                cell(printed("%.0f", static_cast<double>(c.clipped.contacts) / poses), 10) +
                cell(share_of(s.from_backend, c.clipped.contacts), 10) +
                cell(share_of(s.from_clip, c.clipped.contacts), 10) +
                cell(share_of(s.from_fallback, c.clipped.contacts), 10) +
                cell(percent(own_normals(c.clipped)), 13) + "\n";
    }
    text +=
        "ms: median inside the collider's call; contacts: mean a pose, by where they come from;\n"
        "own normals: contacts whose normal is the back-end's own, or the plane's.\n";
    for (const study::ColliderFigures& c : r.colliders)
        if (c.own_process) text += "* " + c.info.name + " ran in a process of its own.\n";
    return text;
}

std::string figure(double value, const study::AspectRow& row) {
    if (row.unit.empty() || row.compared == 0) return "–";
    if (row.unit == "ratio") return printed("%.4f", value);
    return printed("%.2g %s", value, row.unit.c_str());
}

std::string totals_table(const ComparisonTotals& t, const ComparisonKind& kind, bool meshes,
                         const std::string& title, bool judged) {
    std::string text = cell("  " + title, 25, false) + cell("tolerance", 11) + cell("wanted", 8) +
                       cell("compared", 10) + cell("within", 10) + cell("median", 12) +
                       cell("99 %", 12) + cell("worst", 12) + "\n";
    for (const study::AspectRow& row : study::rows_of(t, kind, meshes)) {
        text += cell("    " + row.label, 25, false) + cell(row.tolerance, 11) +
                cell(row.wanted < 0 ? "–" : percent(row.wanted), 8) +
                cell(std::to_string(row.compared), 10) +
                cell(row.compared > 0 ? percent(row.within) : "–", 10) +
                cell(figure(row.median, row), 12) + cell(figure(row.p99, row), 12) +
                cell(figure(row.worst, row), 12) + (judged ? "  " + row.verdict : "") + "\n";
    }
    const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    text += printed(
        "    left out: %llu grazing pairs, %llu pairs that are apart, "
        "%llu normals of two equally good axes\n",
        count(t.grazing), count(t.apart), count(t.ambiguous));
    return text;
}

std::string comparison_tables(const ContactComparison& c, const ComparisonKind& kind, bool judged) {
    const std::string what = kind.raw ? "raw" : "clipped";
    std::string text;
    if (c.convex().compared() > 0) text += totals_table(c.convex(), kind, false, what, judged);
    if (c.meshes().compared() > 0)
        text += totals_table(c.meshes(), kind, true, what + ", meshes", judged);
    return text.empty() ? "  " + what + ": neither reports any pair\n" : text;
}

std::string pair_verdict(const study::ComparisonResult& r, const study::PairFigures& pair) {
    if (!r.alike(pair)) return ": THEY DIFFER\n";
    for (const std::size_t i : {pair.first, pair.second})
        if (!r.answered(i)) return ": NO VERDICT, " + r.colliders[i].info.name + " failed\n";
    return ": they agree\n";
}

std::string pair_section(const study::ComparisonResult& r, const study::PairFigures& pair) {
    const SourceInfo &first = r.colliders[pair.first].info, &second = r.colliders[pair.second].info;
    const bool single = first.precision == "single" || second.precision == "single";
    return "\n" + first.name + " and " + second.name + pair_verdict(r, pair) +
           comparison_tables(pair.clipped, {single, false}, true) +
           comparison_tables(pair.raw, {single, true}, r.raw_judged);
}

std::string finding_text(const Scene& scene, const study::ComparisonResult& r,
                         const study::Finding& f) {
    const Disagreement& d = f.disagreement;
    const std::string &first = r.colliders[f.first].info.name,
                      &second = r.colliders[f.second].info.name;
    const int width = static_cast<int>(std::max(first.size(), second.size())) + 1;
    return printed("  %s, ", study::name_of(d.aspect)) + first + " and " + second + ": " +
           study::difference_text(f) + "\n    " + study::body_name(scene, d.a) + " (" +
           study::shape_text(scene, d.a) + ") and " + study::body_name(scene, d.b) + " (" +
           study::shape_text(scene, d.b) +
           printed(") at %.4g s, step %llu\n", d.time, static_cast<unsigned long long>(d.step)) +
           "    " + cell(first + ":", width, false) + " " + study::answer_text(d.first) + "\n    " +
           cell(second + ":", width, false) + " " + study::answer_text(d.second) + "\n";
}

std::string finding_list(const Scene& scene, const study::ComparisonResult& r,
                         const std::vector<study::Finding>& findings, bool raw) {
    std::string text;
    std::size_t left_out = 0;
    std::map<std::tuple<std::size_t, std::size_t, Aspect>, std::size_t> listed;
    for (const study::Finding& f : findings) {
        if (f.raw != raw) continue;
        const bool enough =
            listed[{f.first, f.second, f.disagreement.aspect}]++ >= (raw ? kListedRaw : kListed);
        left_out += enough;
        if (!enough) text += finding_text(scene, r, f);
    }
    if (text.empty()) return {};
    const std::string rest =
        left_out > 0 ? printed("  … and %zu more (--json, --out)\n", left_out) : std::string();
    return std::string("\nWorst disagreements, ") +
           (raw ? "raw (what the back-ends themselves say):\n" : "clipped:\n") + text + rest;
}

std::string troubles(const study::ComparisonResult& r) {
    std::string text;
    for (const study::ColliderFigures& c : r.colliders) {
        for (const bool raw : {false, true}) {
            const study::AnswerFigures& f = raw ? c.raw : c.clipped;
            if (f.failures > 0)
                text +=
                    c.info.name + (raw ? ", raw" : "") +
                    printed(": failed on a part of %llu poses: %s\n",
                            static_cast<unsigned long long>(f.failures), f.first_failure.c_str());
            if (f.rejected > 0)
                text += c.info.name + (raw ? ", raw" : "") +
                        printed(
                            ": gave %llu contacts that are not finite or of no body; they were "
                            "left out\n",
                            static_cast<unsigned long long>(f.rejected));
        }
    }
    return text;
}

std::string verdict(const study::ComparisonResult& r) {
    if (r.agrees()) return "\nThe colliders agree.\n";
    const bool all_alike =
        std::all_of(r.pairs.begin(), r.pairs.end(),
                    [&](const study::PairFigures& pair) { return r.alike(pair); });
    return all_alike ? "\nNo verdict: not all colliders gave whole answers.\n"
                     : "\nThe colliders differ.\n";
}

/// The samples nearest to fifths of the time: a chart in few rows.
std::string free_run_text(const study::ComparisonResult& r, const study::FreeRuns& runs) {
    const std::size_t last = runs.times.size() - 1;
    std::string text =
        printed("\nFree runs: each collider drives a run of its own\n%-38s", "  time");
    for (std::size_t k = 0; k <= 5; ++k)
        text += cell(printed("%.3g s", runs.times[k * last / 5]), 12);
    const auto row = [&](const std::string& name, const std::vector<double>& values,
                         const char* unit) {
        text += cell(printed("\n  %s", name.c_str()), 39, false);
        for (std::size_t k = 0; k <= 5; ++k)
            text += cell(printed("%.3g %s", values[k * last / 5], unit), 12);
    };
    for (const study::Drift& d : runs.drifts) {
        const std::string names =
            r.colliders[d.first].info.name + ", " + r.colliders[d.second].info.name;
        row(names + ": apart, mean", d.mean, "m");
        row(names + ": apart, largest", d.largest, "m");
    }
    for (std::size_t i = 0; i < r.colliders.size(); ++i) {
        row(r.colliders[i].info.name + ": mean height", runs.height[i], "m");
        row(r.colliders[i].info.name + ": energy", runs.energy[i], "J");
    }
    return text + "\n";
}

}  // namespace

std::string comparison_text(const Scene& scene, const study::ComparisonResult& r,
                            const study::FreeRuns* runs) {
    std::string text =
        scene.name +
        printed(": %llu poses over %.4g s", static_cast<unsigned long long>(r.poses), r.time) +
        ", driven by " + r.colliders[r.driver].info.name + "; margin " +
        study::length_text(scene.settings.margin) + "\n\n" + collider_table(r);
    for (const study::PairFigures& pair : r.pairs) text += pair_section(r, pair);
    text +=
        "\nL: longest side of the smaller body; s.: sagitta, e.: longest edge of the meshes' "
        "facets.\n"
        "Raw answers are what the back-ends themselves say; they do not count for the verdict, nor "
        "do\n"
        "normals deeper than 5 % L.\n";
    const std::vector<study::Finding> findings = study::findings_of(r);
    text += finding_list(scene, r, findings, false) + finding_list(scene, r, findings, true);
    const std::string trouble = troubles(r);
    if (!trouble.empty()) text += printed("\n%s", trouble.c_str());
    if (runs) text += free_run_text(r, *runs);
    if (r.diverged_after > 0)
        text += printed("\nThe run diverged in step %llu; nothing after it was compared.\n",
                        static_cast<unsigned long long>(r.diverged_after));
    return text + verdict(r);
}

}  // namespace plumb::app
