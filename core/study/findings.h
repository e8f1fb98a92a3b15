// SPDX-License-Identifier: MIT
/// What a table of runs tells: the cheapest settings for an error, orders of convergence, floors,
/// and what each departure from the paper buys.
#pragma once

#include "study/point.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plumb::study {

/// [row], whether no other row of its subject is at least as exact and cheaper (Pareto).
std::vector<bool> front_of(const StudyTable& table);

/// A curve of a table: rows that differ in how fine they are alone, from coarse to fine.
struct CurveRows {
    std::string subject, curve, precision, collider, contacts;
    Ladder ladder = Ladder::substeps;
    std::vector<std::size_t> rows;  ///< indices into StudyTable::rows
};
std::vector<CurveRows> curves_of(const StudyTable& table);

/// Order of convergence: the slope of a line through the logarithms of error and fineness, over
/// the part of a curve that falls before rounding stops it.
struct Slope {
    double order = 0;         ///< error ~ fineness^−order; of the step: ~ dt^order
    double expected = 0;      ///< by theory; 0: it gives none
    double from = 0, to = 0;  ///< values of the ladder between which it was measured
};
/// Nothing where fewer than three points of the curve fall.
std::optional<Slope> slope_of(const StudyTable& table, const CurveRows& curve);

/// The smallest error of a curve that stopped falling; nothing where it still falls.
std::optional<double> floor_of(const StudyTable& table, const CurveRows& curve);

/// The cheapest row of a subject with at most this error, of those that a user would choose: no
/// departure from the paper switched off, no raw contacts. Nothing where there is none.
std::optional<std::size_t> cheapest(const StudyTable& table, const std::string& subject,
                                    double error);

/// Ratio of the errors of two curves at equal cost: the geometric mean, over the costs that both
/// cover, of what `without` leaves over what `with` leaves. Above 1: `with` is the better.
struct Gain {
    double ratio = 1, from = 0, to = 0;  ///< costs between which it holds [µs/s]
};
std::optional<Gain> gain(const StudyTable& table, const CurveRows& with, const CurveRows& without);

/// What was compared by a gain, in words: "warm start", "single against double".
struct Departure {
    std::string subject, what;
    Gain gain;
};
std::vector<Departure> departures_of(const StudyTable& table);

/// "1 % costs 12 µs …": sentences for a person, of one subject.
std::vector<std::string> advice_on(const StudyTable& table, const SubjectSummary& subject);

/// Of each kind of curve the share of subjects that it solves to their tolerance within τ times the
/// cheapest cost of any (Dolan, Moré 2002). Of a subject without a tolerance: to ten times the
/// smallest error that any of its rows has.
struct Profile {
    std::string name;
    std::vector<std::pair<double, double>> points;  ///< τ, share
};
std::vector<Profile> profiles_of(const StudyTable& table);

}  // namespace plumb::study
