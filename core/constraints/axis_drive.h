// SPDX-License-Identifier: MIT
/// All that acts along or about one axis of a joint, as one. Each row of drive_rows.h answers a
/// rate with the impulse
///
///   λ_i(rate) = −(rate + bias_i)/softness_i, kept within its bounds:
///
/// a falling line with flat ends, or a step where the softness is 0. Their sum is a set-valued
/// force law that falls by slopes and steps, and meets the line of a rate that impulses change by
/// K,
///
///   rate′ = rate + K (λ′ − λ),
///
/// in one point. On what piece of the law that point lies is what a Newton step has to know.
#pragma once

#include "constraints/drive_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

struct AxisDrive {
    static constexpr int kMostRows = 5;  ///< one of each DriveKind
    DriveRow rows[kMostRows];
    int n = 0;

    /// Of two rows that no rate can satisfy, as a greatest speed and a limit that the joint is far
    /// beyond, the first gives way.
    void add(const DriveRow& row) {
        for (int i = 0; i < n; ++i) {
            DriveRow& other = rows[i];
            const bool too_high =
                std::isinf(other.highest) && std::isinf(row.lowest) && other.bias < row.bias;
            const bool too_low =
                std::isinf(other.lowest) && std::isinf(row.highest) && other.bias > row.bias;
            const bool hard = !(other.softness > 0) && !(row.softness > 0);
            if (hard && (too_high || too_low)) other.bias = row.bias;
        }
        rows[n++] = row;
    }
};

/// Where the force law is met.
struct AxisAnswer {
    double rate = 0, impulse = 0;
    bool is_step = false;  ///< the rate is given and the impulse is whatever it needs
    double slope = 0;      ///< else −dλ/drate; 0: the impulse is given

    bool is_row() const { return is_step || slope > 0; }

    /// Whether the law is met on the same step or line, up to rounding.
    bool is_on_piece_of(const AxisAnswer& o) const {
        if (is_step || o.is_step) return is_step == o.is_step && rate == o.rate;
        const double here = impulse + slope * rate, there = o.impulse + o.slope * o.rate;
        return slope == o.slope && std::abs(here - there) <= 1e-9 * std::abs(there);
    }
};

/// λ of one row just below (side −1) or above (side 1) a rate.
inline double impulse_beside(const DriveRow& row, double rate, int side) {
    if (row.softness > 0)
        return std::clamp(-(rate + row.bias) / row.softness, row.lowest, row.highest);
    const bool below = rate < -row.bias || (rate == -row.bias && side < 0);
    return below ? row.highest : row.lowest;
}

inline double impulse_beside(const AxisDrive& axis, double rate, int side) {
    double sum = 0;
    for (int i = 0; i < axis.n; ++i) sum += impulse_beside(axis.rows[i], rate, side);
    return sum;
}

/// −dλ/drate just below or above a rate.
inline double slope_beside(const AxisDrive& axis, double rate, int side) {
    double slope = 0;
    for (int i = 0; i < axis.n; ++i) {
        const DriveRow& row = axis.rows[i];
        if (!(row.softness > 0)) continue;
        const double first = -row.bias - row.softness * row.highest,
                     last = -row.bias - row.softness * row.lowest;
        if (side < 0 ? first < rate && rate <= last : first <= rate && rate < last)
            slope += 1 / row.softness;
    }
    return slope;
}

/// `rate`, `impulse`: λ now and the rate that it left; `response`: K > 0.
inline AxisAnswer answer_of(const AxisDrive& axis, double rate, double impulse, double response) {
    double corners[2 * AxisDrive::kMostRows];
    int n = 0;
    for (int i = 0; i < axis.n; ++i) {
        const DriveRow& row = axis.rows[i];
        if (!(row.lowest < row.highest)) continue;
        for (const double bound : {row.lowest, row.highest})
            if (!(row.softness > 0) || std::isfinite(bound))
                corners[n++] = -row.bias - (row.softness > 0 ? row.softness * bound : 0);
    }
    const auto beyond = [&](double r, int side) {  // how far the line lies to the left of (r, λ(r))
        return r - rate - response * (impulse_beside(axis, r, side) - impulse);
    };
    constexpr double none = std::numeric_limits<double>::infinity();
    double next = none,
           last = n > 0 ? -none : rate;  // first corner not left of the point; last one
    for (int i = 0; i < n; ++i) {
        last = std::max(last, corners[i]);
        if (corners[i] < next && beyond(corners[i], 1) >= 0) next = corners[i];
    }
    const bool behind_all = next == none;
    const double corner = behind_all ? last : next;
    const int side = behind_all ? 1 : -1;
    if (!behind_all && beyond(corner, -1) <= 0)
        return {corner, impulse + (corner - rate) / response, true, 0};
    const double slope = slope_beside(axis, corner, side);
    const double there = impulse_beside(axis, corner, side);
    const double met =
        (rate + response * (there + slope * corner - impulse)) / (1 + response * slope);
    return {met, there + slope * (corner - met), false, slope};
}

/// What each row contributes to the impulse of an answer.
inline void share_impulse(const AxisDrive& axis, const AxisAnswer& answer,
                          double (&impulse)[AxisDrive::kMostRows]) {
    double rest = answer.impulse;
    for (int i = 0; i < axis.n; ++i) {
        const DriveRow& row = axis.rows[i];
        const bool on_step = answer.is_step && !(row.softness > 0) && answer.rate == -row.bias;
        impulse[i] = on_step ? 0 : impulse_beside(row, answer.rate, 1);
        rest -= impulse[i];
    }
    for (int i = 0; i < axis.n; ++i) {
        const DriveRow& row = axis.rows[i];
        if (!(answer.is_step && !(row.softness > 0) && answer.rate == -row.bias)) continue;
        impulse[i] = std::clamp(rest, row.lowest, row.highest);
        rest -= impulse[i];
    }
}

}  // namespace plumb
