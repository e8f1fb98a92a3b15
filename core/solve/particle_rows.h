// SPDX-License-Identifier: MIT
/// Rows of the velocity table, one by one and in double precision.
#pragma once

#include "constraints/connector.h"
#include "math/types.h"
#include "schedule/contact_rows.h"

namespace plumb {

/// What has changed of a row's velocity since the start of the substep [m/s].
template <class Real>
inline Vector3d change_of(const BodyRows<Real>& rows, std::int32_t row) {
    const Real* x = rows.change + static_cast<std::ptrdiff_t>(row) * kBodyRowSize;
    return {double(x[0]), double(x[1]), double(x[2])};
}
template <class Real>
inline void add_change(const BodyRows<Real>& rows, std::int32_t row, const Vector3d& change) {
    Real* x = rows.change + static_cast<std::ptrdiff_t>(row) * kBodyRowSize;
    for (int k = 0; k < 3; ++k) x[k] = static_cast<Real>(double(x[k]) + change[k]);
}

/// The whole velocity of a row in this substep.
template <class Real>
inline Velocity<double> velocity_of(const BodyRows<Real>& rows, std::int32_t row) {
    const auto at = static_cast<std::ptrdiff_t>(row) * kBodyRowSize;
    const auto sum = [&](int k) {
        return double(rows.start[at + k]) + double(rows.change[at + k]);
    };
    return {{sum(0), sum(1), sum(2)}, {sum(4), sum(5), sum(6)}};
}

/// Adds to what has changed of a row, unless it never does.
template <class Real>
inline void add_change(const BodyRows<Real>& rows, std::int32_t row,
                       const Velocity<double>& change) {
    if (row >= rows.dynamic_count) return;
    Real* x = rows.change + static_cast<std::ptrdiff_t>(row) * kBodyRowSize;
    for (int k = 0; k < 3; ++k) {
        x[k] = static_cast<Real>(double(x[k]) + change.v[k]);
        x[4 + k] = static_cast<Real>(double(x[4 + k]) + change.w[k]);
    }
}

/// Where a particle is at the end of the substep as things stand, against the point that all
/// previews are told against [m].
template <class Real>
inline Vector3d preview_of(const BodyRows<Real>& rows, std::int32_t row, double h) {
    const Real* x = rows.preview + static_cast<std::ptrdiff_t>(row) * kBodyRowSize;
    return Vector3d(double(x[0]) + double(x[4]), double(x[1]) + double(x[5]),
                    double(x[2]) + double(x[6])) +
           h * change_of(rows, row);
}

}  // namespace plumb
