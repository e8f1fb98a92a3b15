// SPDX-License-Identifier: MIT
/// Small dense symmetric systems over any number type.
#pragma once

#include "math/pivot.h"

namespace plumb {

/// Solves K x = c in place by LDLᵀ; K is symmetric and positive definite, and only its lower
/// triangle is read. Leaves the factors in `k` and x in `c`.
template <class T, int N>
inline void solve_ldlt(T (&k)[N][N], T (&c)[N]) {
    for (int j = 0; j < N; ++j) {
        const T entry = k[j][j];
        for (int p = 0; p < j; ++p) {
            const T scaled = k[j][p] * k[p][p];
            k[j][j] = k[j][j] - k[j][p] * scaled;
            for (int i = j + 1; i < N; ++i) k[i][j] = k[i][j] - k[i][p] * scaled;
        }
        k[j][j] = held_pivot<T>(k[j][j], entry);
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

/// K = L D Lᵀ in place, of the first n rows: L below the diagonal, 1/D on it. Only K's lower
/// triangle is read.
template <class T, int N>
inline void factor_ldlt(T (&k)[N][N], int n) {
    T d[N];
    for (int j = 0; j < n; ++j) {
        T scaled[N] = {};
        d[j] = k[j][j];
        for (int p = 0; p < j; ++p) {
            scaled[p] = k[j][p] * d[p];
            d[j] = d[j] - k[j][p] * scaled[p];
        }
        d[j] = held_pivot<T>(d[j], k[j][j]);
        k[j][j] = T(1) / d[j];
        for (int i = j + 1; i < n; ++i) {
            for (int p = 0; p < j; ++p) k[i][j] = k[i][j] - k[i][p] * scaled[p];
            k[i][j] = k[i][j] * k[j][j];
        }
    }
}

/// x ← L⁻¹ x, x ← L⁻ᵀ D⁻¹ x, and x ← K⁻¹ x, by the factors of K.
template <class T, int N>
inline void solve_lower(const T (&factors)[N][N], int n, T* x) {
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j) x[i] = x[i] - factors[i][j] * x[j];
}
template <class T, int N>
inline void solve_upper(const T (&factors)[N][N], int n, T* x) {
    for (int i = n - 1; i >= 0; --i) {
        x[i] = x[i] * factors[i][i];
        for (int j = i + 1; j < n; ++j) x[i] = x[i] - factors[j][i] * x[j];
    }
}
template <class T, int N>
inline void solve_factored(const T (&factors)[N][N], int n, T* x) {
    solve_lower(factors, n, x);
    solve_upper(factors, n, x);
}

}  // namespace plumb
