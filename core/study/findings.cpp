// SPDX-License-Identifier: MIT
#include "study/findings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <tuple>

namespace plumb::study {
namespace {

bool can_be_drawn(const Row& r) {
    return r.status == Status::done && !r.errors.empty() && !r.costs.empty();
}

/// How fine a row is: substeps, iterations, steps per second, or 1/accuracy.
double fineness(const Row& r) { return falls(r.point.ladder) ? 1 / r.point.value : r.point.value; }

/// Whether the point is what a user would choose, rather than a departure switched off to see what
/// it buys.
bool is_for_users(const Point& p) {
    return p.contacts == "shared" &&
           (p.curve == "pbd" || p.curve == kLeapfrogCurve || p.curve.rfind("joints ", 0) == 0);
}

struct Dot {
    double x, y;
};

/// Logarithms of fineness and error of a curve's rows that have an error above 0.
std::vector<Dot> convergence(const StudyTable& table, const CurveRows& curve) {
    std::vector<Dot> dots;
    for (const std::size_t i : curve.rows) {
        const Row& r = table.rows[i];
        if (r.status == Status::done && !r.errors.empty() && r.error() > 0)
            dots.push_back({std::log(fineness(r)), std::log(r.error())});
    }
    return dots;
}

/// Slope of the line through dots [begin, end) by least squares.
double fitted(const std::vector<Dot>& dots, std::size_t begin, std::size_t end) {
    double x = 0, y = 0, xx = 0, xy = 0;
    const auto n = static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) x += dots[i].x / n, y += dots[i].y / n;
    for (std::size_t i = begin; i < end; ++i) {
        xx += (dots[i].x - x) * (dots[i].x - x);
        xy += (dots[i].x - x) * (dots[i].y - y);
    }
    return xy / xx;
}

/// Whether from each dot of [begin, end) to the next the error falls as the whole of them does.
bool is_straight(const std::vector<Dot>& dots, std::size_t begin, std::size_t end) {
    constexpr double kFalls = 0.3, kAlike = 0.25;
    const double slope = fitted(dots, begin, end);
    if (slope > -kFalls) return false;
    for (std::size_t i = begin; i + 1 < end; ++i)
        if (std::abs(fitted(dots, i, i + 2) - slope) > kAlike * std::max(1.0, -slope)) return false;
    return true;
}

/// Error that a curve reaches at a cost: the least of what costs at most that much, on a straight
/// line between logarithms.
class Envelope {
public:
    Envelope(const StudyTable& table, const CurveRows& curve) {
        for (const std::size_t i : curve.rows) {
            const Row& r = table.rows[i];
            if (can_be_drawn(r) && r.error() > 0)
                dots_.push_back({std::log(r.median_cost().total), std::log(r.error())});
        }
        std::sort(dots_.begin(), dots_.end(), [](const Dot& p, const Dot& q) { return p.x < q.x; });
        for (std::size_t i = 1; i < dots_.size(); ++i)
            dots_[i].y = std::min(dots_[i].y, dots_[i - 1].y);
    }

    bool empty() const { return dots_.size() < 2; }
    double first() const { return dots_.front().x; }
    double last() const { return dots_.back().x; }

    double at(double x) const {
        const auto above = std::lower_bound(dots_.begin() + 1, dots_.end() - 1, x,
                                            [](const Dot& d, double value) { return d.x < value; });
        const Dot &p = *(above - 1), &q = *above;
        return q.x > p.x ? p.y + (q.y - p.y) * (x - p.x) / (q.x - p.x) : q.y;
    }

private:
    std::vector<Dot> dots_;
};

double least_error(const StudyTable& table, const std::string& subject) {
    double least = std::numeric_limits<double>::infinity();
    for (const Row& r : table.rows)
        if (r.point.subject == subject && can_be_drawn(r)) least = std::min(least, r.error());
    return least;
}

const CurveRows* find_curve(const std::vector<CurveRows>& curves, const std::string& subject,
                            const std::string& curve, const std::string& precision, Ladder ladder,
                            const std::string& collider = {}) {
    for (const CurveRows& c : curves)
        if (c.subject == subject && c.curve == curve && c.precision == precision &&
            c.ladder == ladder && (collider.empty() || c.collider == collider))
            return &c;
    return nullptr;
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value >= 100 && value < 1e6 ? "%.0f" : "%.2g", value);
    return text;
}

/// An error as a person says it: "1 %", "0.1 mm", "0.001 rad".
std::string error_text(double error, const std::string& unit) {
    if (unit.empty()) return short_number(100 * error) + " %";
    if (unit == "m" && error < 1e-4) return short_number(1e6 * error) + " µm";
    if (unit == "m" && error < 0.1) return short_number(1e3 * error) + " mm";
    return short_number(error) + " " + unit;
}

std::string settings_sentence(const Point& p) {
    char value[32];
    std::snprintf(value, sizeof value, "%g", p.value);
    std::string text;
    if (p.ladder == Ladder::substeps)
        text = std::string(value) + (p.value == 1 ? " substep" : " substeps") + " × 1 iteration";
    if (p.ladder == Ladder::iterations)
        text = "1 substep × " + std::string(value) + (p.value == 1 ? " iteration" : " iterations");
    if (p.ladder == Ladder::step) text = "steps of " + std::string(value) + " s";
    if (p.ladder == Ladder::accuracy) text = "an accuracy of " + std::string(value);
    text += " in " + p.precision;
    if (p.curve != "pbd") text += ", " + p.curve;
    return text + ", on " + p.collider;
}

}  // namespace

std::vector<bool> front_of(const StudyTable& table) {
    std::vector<bool> front(table.rows.size(), false);
    for (const SubjectSummary& s : table.subjects) {
        std::vector<std::size_t> rows;
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            if (table.rows[i].point.subject == s.name && can_be_drawn(table.rows[i]))
                rows.push_back(i);
        std::sort(rows.begin(), rows.end(), [&](std::size_t i, std::size_t j) {
            const Row &a = table.rows[i], &b = table.rows[j];
            return std::tuple(a.median_cost().total, a.error(), i) <
                   std::tuple(b.median_cost().total, b.error(), j);
        });
        double best = std::numeric_limits<double>::infinity();
        for (const std::size_t i : rows) {
            front[i] = table.rows[i].error() < best;
            best = std::min(best, table.rows[i].error());
        }
    }
    return front;
}

std::vector<CurveRows> curves_of(const StudyTable& table) {
    std::vector<CurveRows> curves;
    std::map<std::tuple<std::string, std::string, std::string, Ladder, std::string>, std::size_t>
        known;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const Point& p = table.rows[i].point;
        const auto [at, is_new] = known.try_emplace(
            {p.subject, p.curve, p.precision, p.ladder, p.collider}, curves.size());
        if (is_new)
            curves.push_back(
                {p.subject, p.curve, p.precision, p.collider, p.contacts, p.ladder, {}});
        curves[at->second].rows.push_back(i);
    }
    for (CurveRows& c : curves)
        std::sort(c.rows.begin(), c.rows.end(), [&](std::size_t i, std::size_t j) {
            return fineness(table.rows[i]) < fineness(table.rows[j]);
        });
    return curves;
}

std::optional<Slope> slope_of(const StudyTable& table, const CurveRows& curve) {
    const std::vector<Dot> dots = convergence(table, curve);
    std::size_t best_begin = 0, best_end = 0;
    for (std::size_t begin = 0; begin + 3 <= dots.size(); ++begin)
        for (std::size_t end = begin + 3; end <= dots.size(); ++end)
            if (end - begin > best_end - best_begin && is_straight(dots, begin, end))
                best_begin = begin, best_end = end;
    if (best_end == best_begin) return std::nullopt;
    Slope slope;
    slope.order = -fitted(dots, best_begin, best_end);
    const auto value = [&](std::size_t i) {
        return std::exp(falls(curve.ladder) ? -dots[i].x : dots[i].x);
    };
    slope.from = value(best_begin);
    slope.to = value(best_end - 1);
    const Orders& orders = table.find(curve.subject)->orders;
    if (curve.curve == kLeapfrogCurve) return slope;  // orders are stated without it
    switch (curve.ladder) {
        case Ladder::substeps:
            slope.expected = orders.substeps;
            break;
        case Ladder::iterations:
            slope.expected = orders.iterations;
            break;
        case Ladder::step:
            slope.expected = orders.step;
            break;
        case Ladder::accuracy:
            break;
    }
    return slope;
}

std::optional<double> floor_of(const StudyTable& table, const CurveRows& curve) {
    const std::vector<Dot> dots = convergence(table, curve);
    const std::size_t n = dots.size();
    constexpr double kFalls = -0.3;
    if (n < 3 || fitted(dots, n - 2, n) < kFalls || !slope_of(table, curve)) return std::nullopt;
    double least = dots[0].y;
    for (const Dot& d : dots) least = std::min(least, d.y);
    return std::exp(least);
}

std::optional<std::size_t> cheapest(const StudyTable& table, const std::string& subject,
                                    double error) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const Row& r = table.rows[i];
        if (r.point.subject != subject || !can_be_drawn(r) || r.error() > error) continue;
        if (!is_for_users(r.point)) continue;
        if (!best || r.median_cost().total < table.rows[*best].median_cost().total) best = i;
    }
    return best;
}

std::optional<Gain> gain(const StudyTable& table, const CurveRows& with, const CurveRows& without) {
    const Envelope p(table, with), q(table, without);
    if (p.empty() || q.empty()) return std::nullopt;
    const double from = std::max(p.first(), q.first()), to = std::min(p.last(), q.last());
    if (!(from < to)) return std::nullopt;
    constexpr int kSamples = 32;
    double sum = 0;
    for (int i = 0; i < kSamples; ++i) {
        const double x = from + (to - from) * i / (kSamples - 1);
        sum += q.at(x) - p.at(x);
    }
    return Gain{std::exp(sum / kSamples), std::exp(from), std::exp(to)};
}

std::vector<Departure> departures_of(const StudyTable& table) {
    const std::vector<CurveRows> curves = curves_of(table);
    std::vector<Departure> all;
    for (const SubjectSummary& s : table.subjects) {
        const auto add = [&](const std::string& what, const CurveRows* with,
                             const CurveRows* without) {
            if (!with || !without) return;
            if (const auto found = gain(table, *with, *without))
                all.push_back({s.name, what, *found});
        };
        const auto pbd = [&](const char* precision, Ladder ladder,
                             const std::string& collider = {}) {
            return find_curve(curves, s.name, "pbd", precision, ladder, collider);
        };
        const CurveRows* base = pbd("single", Ladder::substeps);
        add("substeps against iterations", base, pbd("single", Ladder::iterations));
        add("single against double", base, pbd("double", Ladder::substeps));
        for (const CurveRows& c : curves) {
            if (c.subject != s.name || c.curve == "pbd") continue;
            const std::string what =
                c.curve == "paper"
                    ? "departures from the paper, by " + std::string(name_of(c.ladder))
                : c.curve.rfind("without ", 0) == 0 ? c.curve.substr(8)
                                                    : "the default against " + c.curve;
            add(what + (c.contacts == "raw" ? " of " + c.collider : ""),
                pbd("single", c.ladder, c.collider), &c);
        }
    }
    return all;
}

std::vector<std::string> advice_on(const StudyTable& table, const SubjectSummary& subject) {
    constexpr std::size_t kMost = 4;
    const std::string& unit = subject.metrics.front().unit;
    double most = 0;
    bool any = false;
    for (const Row& r : table.rows)
        if (r.point.subject == subject.name && can_be_drawn(r) && is_for_users(r.point))
            most = std::max(most, r.error()), any = true;
    if (unit.empty()) most = std::min(most, 0.1);
    std::vector<std::string> sentences;
    if (any && !(most > 0)) sentences.push_back("no settings that were run leave any error");
    if (!(most > 0)) return sentences;
    std::optional<std::size_t> before;
    const double least = 2 * subject.reference_error;
    int decade = static_cast<int>(std::floor(std::log10(most)));
    for (; sentences.size() < kMost && decade > -16; --decade) {
        const double error = std::pow(10.0, decade);
        if (error < least) break;
        const auto row = cheapest(table, subject.name, error);
        if (!row) break;
        if (row == before) sentences.pop_back();  // it does better yet
        before = row;
        const Row& r = table.rows[*row];
        sentences.push_back(error_text(error, unit) + " costs " +
                            short_number(r.median_cost().total) +
                            " µs of CPU a simulated second: " + settings_sentence(r.point));
    }
    return sentences;
}

std::vector<Profile> profiles_of(const StudyTable& table) {
    const auto name_of_kind = [](const Point& p) {
        return p.curve + " " + p.precision + ", by " + std::string(name_of(p.ladder));
    };
    std::map<std::string, std::map<std::string, double>> costs;  // [kind][subject]
    std::map<std::string, double> least;                         // [subject]
    for (const Row& r : table.rows) {
        const SubjectSummary& s = *table.find(r.point.subject);
        const double wanted = s.tolerance > 0 ? s.tolerance : 10 * least_error(table, s.name);
        if (!can_be_drawn(r) || r.error() > wanted) continue;
        const double cost = r.median_cost().total;
        auto& of_kind = costs[name_of_kind(r.point)];
        const auto at = of_kind.try_emplace(s.name, cost).first;
        at->second = std::min(at->second, cost);
        const auto all = least.try_emplace(s.name, cost).first;
        all->second = std::min(all->second, cost);
    }
    std::vector<Profile> profiles;
    for (const auto& [kind, of_kind] : costs) {
        std::vector<double> ratios;
        for (const auto& [subject, cost] : of_kind) ratios.push_back(cost / least[subject]);
        std::sort(ratios.begin(), ratios.end());
        Profile profile{kind, {}};
        for (std::size_t i = 0; i < ratios.size(); ++i)
            profile.points.emplace_back(
                ratios[i], static_cast<double>(i + 1) / static_cast<double>(table.subjects.size()));
        profiles.push_back(profile);
    }
    return profiles;
}

}  // namespace plumb::study
