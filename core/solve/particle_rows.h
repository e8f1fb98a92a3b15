// SPDX-License-Identifier: MIT
/// Particles' rows of the velocity table, one by one and in double precision.
#pragma once

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
