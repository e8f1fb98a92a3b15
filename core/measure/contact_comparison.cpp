// SPDX-License-Identifier: MIT
#include "measure/contact_comparison.h"

#include "measure/mesh_resolution.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace plumb {

/// One pair of bodies at one moment, as both colliders see it.
struct ContactComparison::Pair {
    std::uint32_t a, b;
    PairContacts first, second;
    const ContactAnswers& answers;
    bool mesh;
    ComparisonTotals& totals;
    PairTolerances tolerances{};
};

namespace {

double degrees_between(const Vector3d& n, const Vector3d& m) {
    return std::atan2(n.cross(m).norm(), n.dot(m)) * 180 / std::numbers::pi;
}

/// The contacts from `begin` on that are of one pair of bodies; moves `begin` behind them.
PairContacts next_pair(std::span<const Contact> contacts, std::size_t& begin) {
    const std::size_t from = begin;
    while (begin < contacts.size() && contacts[begin].a == contacts[from].a &&
           contacts[begin].b == contacts[from].b)
        ++begin;
    return contacts.subspan(from, begin - from);
}

std::pair<std::uint32_t, std::uint32_t> bodies_at(std::span<const Contact> contacts,
                                                  std::size_t i) {
    if (i >= contacts.size()) return {~0u, ~0u};
    return {contacts[i].a, contacts[i].b};
}

void count(AspectTotals& totals, double error, bool within) {
    totals.errors.add(error);
    totals.within += within;
}

}  // namespace

double ComparisonTotals::pair_share() const {
    return compared() > 0 ? static_cast<double>(agreed) / static_cast<double>(compared()) : 1;
}

bool ComparisonTotals::agrees() const {
    return agreed == compared() && gap.share() >= kGapShare && deep_gap.share() >= kDeepGapShare &&
           normal.share() >= kNormalShare && extent.share() >= kExtentShare;
}

ContactComparison::ContactComparison(std::vector<ComparedBody> bodies, const ComparisonKind& kind)
    : bodies_(std::move(bodies)), kind_(kind) {
    for (const ComparedBody& body : bodies_) {
        const MeshResolution mesh = body.shape ? mesh_resolution(*body.shape) : MeshResolution{};
        extent_.push_back(body.shape ? extent_of(*body.shape) : 0);
        mesh_.push_back(body.shape && has_triangles(*body.shape));
        sagitta_.push_back(mesh.sagitta);
        edge_.push_back(mesh.longest_edge);
    }
}

void ContactComparison::add(const ContactAnswers& answers) {
    std::size_t i = 0, j = 0;
    while (i < answers.first.size() || j < answers.second.size()) {
        const auto of_first = bodies_at(answers.first, i), of_second = bodies_at(answers.second, j);
        const auto [a, b] = std::min(of_first, of_second);
        const bool mesh = mesh_[a] || mesh_[b];
        Pair pair{a, b, {}, {}, answers, mesh, mesh ? meshes_ : convex_};
        if (of_first <= of_second) pair.first = next_pair(answers.first, i);
        if (of_second <= of_first) pair.second = next_pair(answers.second, j);
        pair.tolerances = tolerances_of(pair);
        pair.first.empty() || pair.second.empty() ? missing(pair) : compare(pair);
    }
}

PairTolerances ContactComparison::tolerances_of(const Pair& pair) const {
    double size = std::min(extent_[pair.a], extent_[pair.b]);
    if (!std::isfinite(size) || !(size > 0)) size = 1;
    return pair.mesh ? mesh_tolerances(kind_, size, sagitta_[pair.a] + sagitta_[pair.b])
                     : convex_tolerances(kind_, size);
}

/// Only one of the two reports the pair.
void ContactComparison::missing(const Pair& pair) {
    const PairTolerances& t = pair.tolerances;
    const double gap = deepest(pair.first.empty() ? pair.second : pair.first).gap;
    const double from_bands = std::min(std::abs(gap), std::abs(gap - pair.answers.margin));
    if (from_bands <= t.grazing) {
        ++pair.totals.grazing;
        return;
    }
    if (t.only_overlap && gap > 0) {
        ++pair.totals.apart;
        return;
    }
    ++(pair.first.empty() ? pair.totals.only_second : pair.totals.only_first);
    keep(pair, Aspect::pair, from_bands, t.grazing);
}

void ContactComparison::compare(const Pair& pair) {
    ++pair.totals.agreed;
    compare_gaps(pair);
    compare_normals(pair);
}

void ContactComparison::compare_gaps(const Pair& pair) {
    const PairTolerances& t = pair.tolerances;
    const double first = deepest(pair.first).gap, second = deepest(pair.second).gap;
    const double error = std::abs(first - second);
    const bool shallow = -std::min(first, second) <= kShallow * t.size;
    const double tolerance = shallow ? t.gap : t.deep_gap;
    const double unit = pair.mesh ? t.grazing : t.size;
    count(shallow ? pair.totals.gap : pair.totals.deep_gap, error / unit, error <= tolerance);
    if (error > tolerance) keep(pair, shallow ? Aspect::gap : Aspect::deep_gap, error, tolerance);
}

void ContactComparison::compare_normals(const Pair& pair) {
    const PairTolerances& t = pair.tolerances;
    const Contact &first = deepest(pair.first), &second = deepest(pair.second);
    const Vector3d n = pair.mesh ? mean_normal(pair.first) : to_eigen(first.normal);
    const Vector3d m = pair.mesh ? mean_normal(pair.second) : to_eigen(second.normal);
    const double degrees = degrees_between(n, m);
    const bool same = degrees <= t.normal_degrees;
    if (!same && !pair.mesh && equal_axes(pair, n, m)) {
        ++pair.totals.ambiguous;
        return;
    }
    const bool deep = -std::min(first.gap, second.gap) > kDeep * t.size;
    count(deep ? pair.totals.deep_normal : pair.totals.normal, degrees, same);
    if (!same) keep(pair, deep ? Aspect::deep_normal : Aspect::normal, degrees, t.normal_degrees);
    if (same && !deep) compare_extents(pair);
}

bool ContactComparison::equal_axes(const Pair& pair, const Vector3d& n, const Vector3d& m) const {
    const ComparedBody &a = bodies_[pair.a], &b = bodies_[pair.b];
    const auto gap_of = [&](const Contact& c, const Vector3d& axis) {
        const PlacedShape pa = placed_part(*a.shape, a.local, pair.answers.poses[pair.a], c.part_a);
        const PlacedShape pb = placed_part(*b.shape, b.local, pair.answers.poses[pair.b], c.part_b);
        return axis_gap(pa, pb, axis);
    };
    const Contact &first = deepest(pair.first), &second = deepest(pair.second);
    const double gap_n = gap_of(first, n), gap_m = gap_of(second, m);
    if (!(std::abs(gap_n - gap_m) < kEqualAxes * pair.tolerances.size)) return false;
    // Other parts of a compound are other axes; opposite normals have no half-way.
    if (first.part_a != second.part_a || first.part_b != second.part_b) return true;
    const Vector3d sum = n + m;
    if (!(sum.norm() > 1e-6)) return true;
    return gap_of(first, sum.normalized()) < std::min(gap_n, gap_m);
}

void ContactComparison::compare_extents(const Pair& pair) {
    const PairTolerances& t = pair.tolerances;
    double deficit = 0;
    if (pair.mesh) {
        const double edge = std::max({edge_[pair.a], edge_[pair.b], 1e-12});
        deficit = footprint_distance(pair.first, pair.second) / edge;
    } else {
        const double highest = kind_.raw ? t.grazing : pair.answers.margin;
        PatchExtent p = patch_extent(pair.first, highest), q = patch_extent(pair.second, highest);
        if (p.span < q.span) std::swap(p, q);
        if (!(p.span > kLeastExtent * t.size)) return;
        const bool face = std::max(p.area, q.area) > kLeastExtent * p.span * p.span;
        deficit =
            face ? 1 - std::min(p.area, q.area) / std::max(p.area, q.area) : 1 - q.span / p.span;
    }
    const bool within = deficit <= t.extent;
    count(pair.totals.extent, deficit, within);
    if (!within) keep(pair, Aspect::extent, deficit, t.extent);
}

void ContactComparison::keep(const Pair& pair, Aspect aspect, double error, double tolerance) {
    std::vector<Disagreement>& list = worst_[static_cast<std::size_t>(aspect)];
    const double severity = error / tolerance;
    const auto same = std::find_if(list.begin(), list.end(), [&](const Disagreement& d) {
        return d.a == pair.a && d.b == pair.b;
    });
    if (same != list.end() && same->severity() >= severity) return;
    if (same == list.end() && list.size() == kKept && list.back().severity() >= severity) return;
    if (same != list.end())
        list.erase(same);
    else if (list.size() == kKept)
        list.pop_back();

    Disagreement d{aspect,
                   error,
                   tolerance,
                   pair.a,
                   pair.b,
                   pair.answers.step,
                   pair.answers.time,
                   pair.answers.poses[pair.a],
                   pair.answers.poses[pair.b],
                   {pair.first.begin(), pair.first.end()},
                   {pair.second.begin(), pair.second.end()}};
    const auto place = std::find_if(list.begin(), list.end(), [&](const Disagreement& other) {
        return other.severity() < severity;
    });
    list.insert(place, std::move(d));
}

std::vector<Disagreement> ContactComparison::worst() const {
    std::vector<Disagreement> all;
    for (const auto& list : worst_) all.insert(all.end(), list.begin(), list.end());
    return all;
}

}  // namespace plumb
