// SPDX-License-Identifier: MIT
#include "study/study_json.h"

#include "study/findings.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace plumb::study {
namespace {

using Json = nlohmann::ordered_json;

Json row_json(const SubjectSummary& s, const Row& r, bool front) {
    const Point& p = r.point;
    Json j = {{"curve", p.curve},
              {"precision", p.precision},
              {"ladder", name_of(p.ladder)},
              {"value", p.value},
              {"collider", p.collider},
              {"contacts", p.contacts},
              {"settings", p.settings_text()},
              {"status", name_of(r.status)},
              {"note", r.note}};
    if (!r.errors.empty()) {
        j["error"] = r.error();
        for (std::size_t m = 1; m < r.errors.size(); ++m)
            j["others"][s.metrics[m].name] = r.errors[m];
    }
    if (!r.costs.empty()) {
        j["us"] = r.median_cost().total;
        j["us_solver"] = r.median_cost().solver;
    }
    j["runs"] = r.costs.size();
    j["front"] = front;
    return j;
}

Json curve_head(const CurveRows& c) {
    return {{"curve", c.curve},
            {"precision", c.precision},
            {"ladder", name_of(c.ladder)},
            {"collider", c.collider},
            {"contacts", c.contacts}};
}

/// A ratio of errors at equal cost, in words.
std::string meaning_of(double ratio) {
    if (ratio > 1.1) return "less error at equal cost";
    return ratio < 0.9 ? "more error at equal cost" : "no difference";
}

Json or_null(double value) { return value > 0 ? Json(value) : Json(nullptr); }

/// All of one subject but its departures.
Json subject_json(const StudyTable& table, const SubjectSummary& s,
                  const std::vector<CurveRows>& curves, const std::vector<bool>& front) {
    const auto& metric = s.metrics.front();
    Json j = {{"name", s.name},
              {"title", s.title},
              {"reference", s.reference},
              {"metric", {{"name", metric.name}, {"unit", metric.unit}, {"what", metric.what}}},
              {"tolerance", or_null(s.tolerance)},
              {"horizon", or_null(s.horizon)},
              {"reference_error", or_null(s.reference_error)},
              {"rows", Json::array()},
              {"slopes", Json::array()},
              {"floors", Json::array()},
              {"advice", advice_on(table, s)},
              {"departures", Json::array()}};
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (table.rows[i].point.subject == s.name)
            j["rows"].push_back(row_json(s, table.rows[i], front[i]));
    for (const CurveRows& c : curves) {
        if (c.subject != s.name) continue;
        if (const auto slope = slope_of(table, c)) {
            Json one = curve_head(c);
            one["slope"] = slope->order;
            one["expected"] = or_null(slope->expected);
            one["from"] = slope->from;
            one["to"] = slope->to;
            j["slopes"].push_back(one);
        }
        if (const auto floor = floor_of(table, c)) {
            Json one = curve_head(c);
            one["error"] = *floor;
            j["floors"].push_back(one);
        }
    }
    return j;
}

}  // namespace

std::string study_json(const StudyTable& table, const std::string& title) {
    const std::vector<CurveRows> curves = curves_of(table);
    const std::vector<bool> front = front_of(table);
    Json subjects = Json::array();
    for (const SubjectSummary& s : table.subjects)
        subjects.push_back(subject_json(table, s, curves, front));
    for (const Departure& d : departures_of(table))
        for (Json& s : subjects)
            if (s["name"] == d.subject)
                s["departures"].push_back({{"what", d.what},
                                           {"ratio", d.gain.ratio},
                                           {"at_us", std::sqrt(d.gain.from * d.gain.to)},
                                           {"note", meaning_of(d.gain.ratio)}});
    Json profiles = Json::array();
    for (const Profile& p : profiles_of(table))
        profiles.push_back({{"name", p.name}, {"points", p.points}});
    const Json j = {
        {"title", title},
        {"machine",
         {{"cpu", table.machine.cpu},
          {"flags", table.machine.flags},
          {"version", table.machine.version}}},
        {"subjects", subjects},
        {"profile",
         {{"what", "share of the subjects solved to their tolerance within τ times the cheapest"},
          {"curves", profiles}}}};
    return j.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace plumb::study
