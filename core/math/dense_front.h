// SPDX-License-Identifier: MIT
/// Dense symmetric elimination, the heart of a sparse one: the first columns of a matrix of n rows
/// are factored, and what they leave to the others is taken off them.
///
/// Columns lie one after another, n numbers each; only the lower triangle counts. Each entry sums
/// its products in one order, whatever the lanes.
#pragma once

#include "math/lanes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace plumb {

namespace front {

inline constexpr std::uint32_t kPanel = 24;

using Four = Lanes<double, 4>;

/// Of any alignment.
inline Four read(const double* from) {
    Four x;
    __builtin_memcpy(&x, from, sizeof x);
    return x;
}

/// Rows [row, n) of `kColumns` columns from `column` on: C −= A Bᵀ, with A the panel's columns
/// [first, last) and B theirs times the pivots, `scaled`[k][column].
template <int kColumns>
inline void take_off(double* f, std::uint32_t n, std::uint32_t first, std::uint32_t last,
                     std::uint32_t column, const double* scaled) {
    const std::size_t ld = n;
    std::uint32_t row = column;
    for (; row + 4 <= n; row += 4) {
        Four sum[kColumns];
        for (int c = 0; c < kColumns; ++c) sum[c] = read(f + (column + c) * ld + row);
        for (std::uint32_t k = first; k < last; ++k) {
            const Four a = read(f + k * ld + row);
            const double* b = scaled + (k - first) * ld + column;
            for (int c = 0; c < kColumns; ++c) sum[c] -= a * Four(b[c]);
        }
        for (int c = 0; c < kColumns; ++c)
            __builtin_memcpy(f + (column + c) * ld + row, &sum[c], sizeof sum[c]);
    }
    for (; row < n; ++row)
        for (int c = 0; c < kColumns; ++c) {
            double sum = f[(column + c) * ld + row];
            for (std::uint32_t k = first; k < last; ++k)
                sum -= f[k * ld + row] * scaled[(k - first) * ld + column + c];
            f[(column + c) * ld + row] = sum;
        }
}

}  // namespace front

/// L D Lᵀ of the first `pivots` columns in place: L below the diagonal, D on it; the rest becomes
/// the Schur complement. `memory` has 24 n numbers. Returns whether all pivots were finite and not
/// 0.
inline bool factor_front(double* f, std::uint32_t n, std::uint32_t pivots, double* memory) {
    const std::size_t ld = n;
    for (std::uint32_t first = 0; first < pivots; first += front::kPanel) {
        const std::uint32_t last = first + front::kPanel < pivots ? first + front::kPanel : pivots;
        for (std::uint32_t j = first; j < last; ++j) {
            double* column = f + j * ld;
            for (std::uint32_t k = first; k < j; ++k) {
                const double* left = f + k * ld;
                const double scaled = memory[(k - first) * ld + j];
                for (std::uint32_t i = j; i < n; ++i) column[i] -= left[i] * scaled;
            }
            const double pivot = column[j];
            if (!(std::abs(pivot) > 0) || !std::isfinite(pivot)) return false;
            const double inverse = 1 / pivot;
            double* scaled = memory + (j - first) * ld;
            for (std::uint32_t i = j + 1; i < n; ++i) {
                scaled[i] = column[i];
                column[i] *= inverse;
            }
        }
        std::uint32_t column = last;
        for (; column + 4 <= n; column += 4) front::take_off<4>(f, n, first, last, column, memory);
        for (; column < n; ++column) front::take_off<1>(f, n, first, last, column, memory);
    }
    return true;
}

}  // namespace plumb
