// SPDX-License-Identifier: MIT
/// Small dense symmetric systems over any number type.
#pragma once

namespace plumb {

/// Solves K x = c in place by LDLᵀ; K is symmetric and positive definite, and only its lower
/// triangle is read. Leaves the factors in `k` and x in `c`.
template <class T, int N>
inline void solve_ldlt(T (&k)[N][N], T (&c)[N]) {
    for (int j = 0; j < N; ++j) {
        for (int p = 0; p < j; ++p) {
            const T scaled = k[j][p] * k[p][p];
            k[j][j] = k[j][j] - k[j][p] * scaled;
            for (int i = j + 1; i < N; ++i) k[i][j] = k[i][j] - k[i][p] * scaled;
        }
        const T inverse = T(1) / k[j][j];
        for (int i = j + 1; i < N; ++i) k[i][j] = k[i][j] * inverse;
    }
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < i; ++j) c[i] = c[i] - k[i][j] * c[j];
    for (int i = N - 1; i >= 0; --i) {
        c[i] = c[i] / k[i][i];
        for (int j = i + 1; j < N; ++j) c[i] = c[i] - k[j][i] * c[j];
    }
}

}  // namespace plumb
