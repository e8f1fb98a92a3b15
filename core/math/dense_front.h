// SPDX-License-Identifier: MIT
/// Dense symmetric elimination, the heart of a sparse one: the first columns of a matrix of n rows
/// are factored, and what they leave to the others is taken off them.
///
/// Columns lie one after another, n numbers each; only the lower triangle counts. Each entry sums
/// its products in one order, whatever the lanes.
#pragma once

#include "math/lanes.h"
#include "math/types.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace plumb {

namespace front {

inline constexpr std::uint32_t kPanel = 24;
/// Columns of a panel that are factored one by one, after those before them have been taken off.
inline constexpr std::uint32_t kNear = 6;

/// Of any alignment.
template <int W>
Lanes<double, W> read(const double* from) {
    Lanes<double, W> x;
    __builtin_memcpy(&x, from, sizeof x);
    return x;
}

/// Rows from `row` on, kParts times W at once as long as there are so many, of `kColumns` columns
/// from `column` on: C −= A Bᵀ, with A the panel's columns [first, last) and B theirs times the
/// pivots, `scaled`[k][column]. Returns the row after them.
template <int W, int kParts, int kColumns>
std::uint32_t take_off_rows(double* f, std::uint32_t n, std::uint32_t row, std::uint32_t first,
                            std::uint32_t last, std::uint32_t column, const double* scaled) {
    const std::size_t ld = n;
    for (; row + kParts * W <= n; row += kParts * W) {
        Lanes<double, W> sum[kColumns][kParts];
        for (int c = 0; c < kColumns; ++c)
            for (int p = 0; p < kParts; ++p)
                sum[c][p] = read<W>(f + (column + c) * ld + row + p * W);
        for (std::uint32_t k = first; k < last; ++k) {
            const double* b = scaled + (k - first) * ld + column;
            Lanes<double, W> a[kParts];
            for (int p = 0; p < kParts; ++p) a[p] = read<W>(f + k * ld + row + p * W);
            for (int c = 0; c < kColumns; ++c)
                for (int p = 0; p < kParts; ++p) sum[c][p] -= a[p] * Lanes<double, W>(b[c]);
        }
        for (int c = 0; c < kColumns; ++c)
            for (int p = 0; p < kParts; ++p)
                __builtin_memcpy(f + (column + c) * ld + row + p * W, &sum[c][p], sizeof sum[c][p]);
    }
    return row;
}

/// Those of all rows from `column` on.
template <int W, int kColumns>
void take_off(double* f, std::uint32_t n, std::uint32_t first, std::uint32_t last,
              std::uint32_t column, const double* scaled) {
    std::uint32_t row = take_off_rows<W, 2, kColumns>(f, n, column, first, last, column, scaled);
    row = take_off_rows<W, 1, kColumns>(f, n, row, first, last, column, scaled);
    row = take_off_rows<2, 1, kColumns>(f, n, row, first, last, column, scaled);
    take_off_rows<1, 1, kColumns>(f, n, row, first, last, column, scaled);
}

/// Those of columns [column, end), kColumns at once as long as there are so many.
template <int W, int kColumns>
void take_off_all(double* f, std::uint32_t n, std::uint32_t first, std::uint32_t last,
                  std::uint32_t column, std::uint32_t end, const double* scaled) {
    for (; column + kColumns <= end; column += kColumns)
        take_off<W, kColumns>(f, n, first, last, column, scaled);
    for (; column < end; ++column) take_off<W, 1>(f, n, first, last, column, scaled);
}

/// L and D of columns [near, end) of the panel that begins at `first`, off which those before have
/// been taken; and what they are times the pivots, `memory`[k − first][row].
template <int W>
bool factor_near(double* f, std::uint32_t n, std::uint32_t first, std::uint32_t near,
                 std::uint32_t end, double* memory) {
    const std::size_t ld = n;
    for (std::uint32_t j = near; j < end; ++j) {
        double* column = f + j * ld;
        for (std::uint32_t k = near; k < j; ++k) {
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
    return true;
}

/// L D Lᵀ of the first `pivots` columns in place: L below the diagonal, D on it; the rest becomes
/// the Schur complement. `memory` has kPanel n numbers. Returns whether all pivots were finite and
/// not 0.
template <int W>
bool factor(double* f, std::uint32_t n, std::uint32_t pivots, double* memory) {
    for (std::uint32_t first = 0; first < pivots; first += kPanel) {
        const std::uint32_t last = first + kPanel < pivots ? first + kPanel : pivots;
        for (std::uint32_t near = first; near < last; near += kNear) {
            const std::uint32_t end = near + kNear < last ? near + kNear : last;
            take_off_all<W, kNear>(f, n, first, near, near, end, memory);
            if (!factor_near<W>(f, n, first, near, end, memory)) return false;
        }
        take_off_all<W, 4>(f, n, first, last, last, n, memory);
    }
    return true;
}

/// Three columns of a front's factors, for all that is read of x and written to it is then read and
/// written once for them all.
struct BlockColumn {
    const double* of[3];

    BlockColumn(const double* factors, std::uint32_t n, std::uint32_t first) {
        for (std::uint32_t k = 0; k < 3; ++k) of[k] = factors + std::size_t(first + k) * n;
    }
    /// y += L x, of `count` rows from `first` on.
    void add_to(std::uint32_t first, std::uint32_t count, const Vector3d& x, double* y) const {
        const double *a = of[0] + first, *b = of[1] + first, *c = of[2] + first;
        const double x0 = x[0], x1 = x[1], x2 = x[2];
        for (std::uint32_t r = 0; r < count; ++r) y[r] += (a[r] * x0 + b[r] * x1) + c[r] * x2;
    }
    /// Lᵀ y, of the same. Rows in turn go to eight sums, which need not wait for each other.
    template <int W>
    Vector3d sum(std::uint32_t first, std::uint32_t count, const double* y) const {
        constexpr int kSums = 8;
        const double* const l[3] = {of[0] + first, of[1] + first, of[2] + first};
        Lanes<double, W> sums[3][kSums / W];
        for (auto& row : sums)
            for (auto& part : row) part = 0;
        std::uint32_t r = 0;
        for (; r + kSums <= count; r += kSums)
            for (int p = 0; p < kSums / W; ++p) {
                const Lanes<double, W> here = read<W>(y + r + p * W);
                for (int k = 0; k < 3; ++k) sums[k][p] += read<W>(l[k] + r + p * W) * here;
            }
        Vector3d all;
        for (int k = 0; k < 3; ++k) {
            double each[kSums];
            __builtin_memcpy(each, &sums[k], sizeof each);
            for (int half = kSums / 2; half > 0; half /= 2)
                for (int i = 0; i < half; ++i) each[i] += each[i + half];
            all[k] = each[0];
        }
        for (; r < count; ++r)
            for (int k = 0; k < 3; ++k) all[k] += l[k][r] * y[r];
        return all;
    }
};

/// With the factors of `pivots` columns, a multiple of three: L⁻¹ of their own rows in place, and
/// what is to be taken off those below, of which there are n − pivots.
inline void solve_down(const double* factors, std::uint32_t n, std::uint32_t pivots, double* own,
                       double* below) {
    for (std::uint32_t i = 0; i < n - pivots; ++i) below[i] = 0;
    for (std::uint32_t c = 0; c < pivots; c += 3) {
        const BlockColumn l(factors, n, c);
        double* here = own + c;
        here[1] -= l.of[0][c + 1] * here[0];
        here[2] -= l.of[0][c + 2] * here[0] + l.of[1][c + 2] * here[1];
        l.add_to(c + 3, pivots - (c + 3), {-here[0], -here[1], -here[2]}, here + 3);
        l.add_to(pivots, n - pivots, {here[0], here[1], here[2]}, below);
    }
}

/// And on to (D Lᵀ)⁻¹ of their own, where those below are known.
template <int W>
void solve_up(const double* factors, std::uint32_t n, std::uint32_t pivots, double* own,
              const double* below) {
    for (std::uint32_t c = pivots; c > 0;) {
        c -= 3;
        const BlockColumn l(factors, n, c);
        double* here = own + c;
        const Vector3d sum =
            l.sum<W>(c + 3, pivots - (c + 3), here + 3) + l.sum<W>(pivots, n - pivots, below);
        here[2] = here[2] / l.of[2][c + 2] - sum[2];
        here[1] = here[1] / l.of[1][c + 1] - sum[1] - l.of[1][c + 2] * here[2];
        here[0] =
            here[0] / l.of[0][c] - sum[0] - l.of[0][c + 1] * here[1] - l.of[0][c + 2] * here[2];
    }
}

}  // namespace front

/// What works on one front. They give the same bits, whatever they were compiled for.
struct FrontKernels {
    bool (*factor)(double* f, std::uint32_t n, std::uint32_t pivots, double* memory);
    void (*solve_down)(const double* factors, std::uint32_t n, std::uint32_t pivots, double* own,
                       double* below);
    void (*solve_up)(const double* factors, std::uint32_t n, std::uint32_t pivots, double* own,
                     const double* below);
};

/// W numbers, one register, at a time.
template <int W>
constexpr FrontKernels front_kernels_of() {
    return {front::factor<W>, front::solve_down, front::solve_up<W>};
}

}  // namespace plumb
