// SPDX-License-Identifier: MIT
#include "study/comparison_rows.h"

#include <cmath>
#include <cstdio>
#include <utility>

namespace plumb::study {
namespace {

template <class... Args>
std::string printed(const char* format, Args... args) {
    char text[200];
    std::snprintf(text, sizeof text, format, args...);
    return text;
}

const char* verdict_of(double wanted, std::uint64_t compared, double within) {
    if (compared == 0) return "–";
    if (wanted < 0) return "not judged";
    return within >= wanted ? "agree" : "DIFFER";
}

AspectRow pair_row(const ComparisonTotals& t) {
    AspectRow row{"pairs", "pairs both report", "all", 1, t.compared(), t.pair_share(), 0, 0, 0, "",
                  ""};
    row.verdict = verdict_of(1, row.compared, row.within);
    return row;
}

AspectRow error_row(const AspectTotals& t, std::string key, std::string label,
                    std::string tolerance, double wanted, std::string unit) {
    const Spread& e = t.errors;
    return {std::move(key),
            std::move(label),
            std::move(tolerance),
            wanted,
            e.count(),
            t.share(),
            e.quantile(0.5),
            e.quantile(0.99),
            e.largest(),
            std::move(unit),
            verdict_of(wanted, e.count(), t.share())};
}

/// Deficits become ratios.
AspectRow as_ratio(AspectRow row) {
    for (double* value : {&row.median, &row.p99, &row.worst}) *value = 1 - *value;
    return row;
}

std::string size_text(const Eigen::Vector3d& half) {
    return printed("%.3g × %.3g × %.3g m", 2 * half.x(), 2 * half.y(), 2 * half.z());
}

}  // namespace

std::vector<AspectRow> rows_of(const ComparisonTotals& t, const ComparisonKind& kind, bool meshes) {
    if (meshes)
        return {
            pair_row(t),
            error_row(t.gap, "gap", "gap, to 1 % L deep", "2 s.", kGapShare, "s."),
            error_row(t.deep_gap, "deep_gap", "gap, deeper", "2 % L, 2 s.", kDeepGapShare, "s."),
            error_row(t.normal, "normal", "mean normal", "6 or 12°", kNormalShare, "°"),
            error_row(t.deep_normal, "deep_normal", "normal, deeper", "6 or 12°", -1, "°"),
            error_row(t.extent, "extent", "footprints apart", "1 e.", kExtentShare, "e.")};
    const PairTolerances tolerances = convex_tolerances(kind, 1);
    return {pair_row(t),
            error_row(t.gap, "gap", "gap, to 1 % L deep", printed("%.0e L", tolerances.gap),
                      kGapShare, "L"),
            error_row(t.deep_gap, "deep_gap", "gap, deeper", printed("%.2g L", tolerances.deep_gap),
                      kDeepGapShare, "L"),
            error_row(t.normal, "normal", "normal, to 5 % L",
                      printed("%.0f°", tolerances.normal_degrees), kNormalShare, "°"),
            error_row(t.deep_normal, "deep_normal", "normal, deeper",
                      printed("%.0f°", tolerances.normal_degrees), -1, "°"),
            as_ratio(error_row(t.extent, "extent", "area (length) ratio",
                               printed("≥ %.2g", 1 - tolerances.extent), kExtentShare, "ratio"))};
}

const char* name_of(Aspect aspect) {
    switch (aspect) {
        case Aspect::pair:
            return "pair";
        case Aspect::gap:
            return "gap";
        case Aspect::deep_gap:
            return "deep gap";
        case Aspect::normal:
            return "normal";
        case Aspect::deep_normal:
            return "deep normal";
        case Aspect::extent:
            return "patch";
    }
    return "?";
}

std::vector<Finding> findings_of(const ComparisonResult& result) {
    std::vector<Finding> findings;
    for (const bool raw : {false, true})
        for (const PairFigures& pair : result.pairs)
            for (Disagreement& d : (raw ? pair.raw : pair.clipped).worst()) {
                const bool judged = (!raw || result.raw_judged) && d.aspect != Aspect::deep_normal;
                findings.push_back({pair.first, pair.second, raw, judged, std::move(d)});
            }
    return findings;
}

std::string body_name(const Scene& scene, std::uint32_t body) {
    const std::string& name = scene.bodies[body].name;
    return name.empty() ? "body " + std::to_string(body) : name;
}

std::string shape_text(const Scene& scene, std::uint32_t body) {
    const Geometry& g = scene.geometries[scene.bodies[body].geometry];
    const std::string kind = plumb::name_of(g.kind);
    switch (g.kind) {
        case ShapeKind::box:
            return kind + " " + size_text(g.half_extents);
        case ShapeKind::sphere:
            return kind + printed(" of radius %.3g m", g.radius);
        case ShapeKind::capsule:
        case ShapeKind::cylinder:
        case ShapeKind::cone:
            return kind + printed(" of radius %.3g m, half height %.3g m", g.radius, g.half_height);
        case ShapeKind::hull:
            return kind + printed(" of %zu vertices", g.vertices.size());
        case ShapeKind::mesh:
            return kind + printed(" of %zu triangles", g.triangles.size());
        case ShapeKind::compound:
            return kind + printed(" of %zu parts", g.parts.size());
        case ShapeKind::plane:
        case ShapeKind::height_field:
            break;
    }
    return kind;
}

std::string length_text(double metres) {
    const double size = std::abs(metres);
    if (size >= 1) return printed("%.3g m", metres);
    if (size >= 1e-3) return printed("%.3g mm", 1e3 * metres);
    if (size >= 1e-6) return printed("%.3g µm", 1e6 * metres);
    return size >= 1e-12 ? printed("%.3g nm", 1e9 * metres) : "0 m";
}

std::string difference_text(const Finding& finding) {
    const Disagreement& d = finding.disagreement;
    switch (d.aspect) {
        case Aspect::pair:
            return "only one reports the pair";
        case Aspect::gap:
        case Aspect::deep_gap:
            return "deepest gaps " + length_text(d.error) + " apart, where " +
                   length_text(d.tolerance) + " are allowed";
        case Aspect::normal:
        case Aspect::deep_normal:
            return printed("normals %.3g° apart, where %.3g° are allowed", d.error, d.tolerance);
        case Aspect::extent:
            return d.tolerance == 1
                       ? printed("footprints %.3g edges apart", d.error)
                       : printed("the smaller patch is %.3g of the larger", 1 - d.error);
    }
    return "?";
}

std::string answer_text(const std::vector<Contact>& contacts) {
    if (contacts.empty()) return "no contact";
    const Contact& c = deepest(contacts);
    return printed("%zu point%s, ", contacts.size(), contacts.size() == 1 ? "" : "s") +
           length_text(std::abs(c.gap)) + (c.gap < 0 ? " deep" : " apart") +
           printed(", normal (%.3f, %.3f, %.3f)", c.normal.x, c.normal.y, c.normal.z) +
           (c.flags & kContactApproximate ? ", said to be approximate" : "");
}

}  // namespace plumb::study
