// SPDX-License-Identifier: MIT
/// The natural logarithm over any number type, by the same operations in each lane.
#pragma once

#include "math/lanes.h"

namespace plumb {

/// log(x) of 10⁻³ … 10⁴ to 5·10⁻⁶, of 0.01 … 100 to 10⁻⁹; near 1 with all digits of x − 1.
///
///   log x = 8 log y = 16 artanh z,  y = x^⅛,  z = (y − 1)/(y + 1)
///
///   y − 1 = (x − 1)/((y + 1)(y² + 1)(y⁴ + 1))
template <class T>
inline T natural_log(const T& x) {
    constexpr int kTerms = 9;
    const T fourth = sqrt(x), second = sqrt(fourth), y = sqrt(second);  // powers of y
    const T more = y + T(1);
    const T z = (x - T(1)) / (more * more * (second + T(1)) * (fourth + T(1))), square = z * z;
    T series(1.0 / (2 * kTerms - 1));
    for (int i = kTerms - 1; i > 0; --i) series = series * square + T(1.0 / (2 * i - 1));
    return T(16) * z * series;
}

}  // namespace plumb
