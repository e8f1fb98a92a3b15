// SPDX-License-Identifier: MIT
/// The loops behind the kernels of constraints among particles. Included by the units of each
/// instruction set and by nothing else.
#pragma once

#include "kernels/gather.h"
#include "kernels/point_kernels.h"

#include <algorithm>
#include <limits>

namespace plumb::kernels {

/// The points of W constraints, against the first of each [m], and what has changed of their
/// velocities [m/s].
template <int N, class T>
struct GatheredPoints {
    Vector3<T> place[N], change[N];

    /// From where the start of the substep takes them, with velocities that they lack.
    template <class Real, int W>
    void move(const Real* velocities, const std::int32_t (&row)[N][W], const T& h) {
        for (int i = 0; i < N; ++i) change[i] = read_points<Real, W>(velocities, row[i]);
        for (int i = 1; i < N; ++i) place[i] += (change[i] - change[0]) * h;
    }
};

/// Where the start of the substep takes them.
template <int N, class Real, int W, class T = Number<Real, W>>
inline GatheredPoints<N, T> gather_previews(const BodyRows<Real>& rows,
                                            const std::int32_t (&row)[N][W]) {
    GatheredPoints<N, T> points;
    Velocity<T> preview[N];
    for (int i = 0; i < N; ++i) preview[i] = read_velocities<Real, W>(rows.preview, row[i]);
    points.place[0] = Vector3<T>(T(0), T(0), T(0));
    for (int i = 1; i < N; ++i)
        points.place[i] = (preview[i].v - preview[0].v) + (preview[i].w - preview[0].w);
    return points;
}

/// At the end of the substep as things stand, of a block that has begun.
template <class F, class Real, int W, class T = Number<Real, W>>
inline GatheredPoints<F::kPoints, T> gather_points(const FormulaBlock<F, Real, W>& block,
                                                   const BodyRows<Real>& rows, const T& h) {
    GatheredPoints<F::kPoints, T> points;
    points.place[0] = Vector3<T>(T(0), T(0), T(0));
    for (int i = 0; i < 3 * (F::kPoints - 1); ++i)
        points.place[1 + i / 3][i % 3] = load(block.apart[i]);
    points.template move<Real, W>(rows.change, block.row, h);
    return points;
}

template <class Real, int N, int W>
inline void load_all(Number<Real, W> (&to)[N], const Real (&from)[N][W]) {
    for (int k = 0; k < N; ++k) to[k] = load(from[k]);
}

/// C of a formula's rows at the given points.
template <class F, class Real, int W, class T = Number<Real, W>>
inline void evaluate(T (&c)[FormulaSize<F>::kRows], const FormulaBlock<F, Real, W>& block,
                     const Vector3<T> (&place)[F::kPoints]) {
    using Size = FormulaSize<F>;
    T numbers[Size::kNumbers];
    load_all<Real, Size::kNumbers, W>(numbers, block.numbers);
    if constexpr (Size::kIsLinear) {
        Vector3<T> sum = place[0] * numbers[0];
        for (int i = 1; i < F::kPoints; ++i) sum += place[i] * numbers[i];
        for (int k = 0; k < 3; ++k) c[k] = sum[k];
    } else {
        const auto rows = F::rows(place, numbers);
        for (int k = 0; k < Size::kRows; ++k) c[k] = rows.c[k];
    }
}

template <class F, class Real, int W>
[[gnu::flatten]] void begin_points(FormulaBlock<F, Real, W>* blocks, const BodyRows<Real>& rows,
                                   Real h, std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    using Size = FormulaSize<F>;
    for (std::uint32_t b = first; b < last; ++b) {
        FormulaBlock<F, Real, W>& block = blocks[b];
        const T damped = load(block.damped);
        T c[Size::kRows];
        for (T& row : c) row = T(0);
        auto points = gather_previews<F::kPoints, Real, W>(rows, block.row);
        for (int i = 0; i < 3 * (F::kPoints - 1); ++i)
            store(block.apart[i], points.place[1 + i / 3][i % 3]);
        if (any_greater(damped, T(0))) {
            points.template move<Real, W>(rows.start, block.row, -T(h));
            evaluate<F, Real, W>(c, block, points.place);
        }
        for (int k = 0; k < Size::kRows; ++k) {
            store(block.lag[k], T(damped * c[k]));
            store(block.impulse[k], T(0));
        }
    }
}

/// What the items of a block know and have done.
template <class F, class Real, int W, class T = Number<Real, W>>
struct LoadedItems {
    using Size = FormulaSize<F>;
    T mass[F::kPoints], numbers[Size::kNumbers], soft[Size::kCompliances], lag[Size::kRows],
        impulse[Size::kRows];

    explicit LoadedItems(const FormulaBlock<F, Real, W>& block) {
        load_all<Real, F::kPoints, W>(mass, block.inverse_mass);
        load_all<Real, Size::kNumbers, W>(numbers, block.numbers);
        load_all<Real, Size::kCompliances, W>(soft, block.softness);
        load_all<Real, Size::kRows, W>(lag, block.lag);
        load_all<Real, Size::kRows, W>(impulse, block.impulse);
    }
};

template <class F, class Real, int W, class T = Number<Real, W>>
inline void store_points(FormulaBlock<F, Real, W>& block, const T (&impulse)[FormulaSize<F>::kRows],
                         const Vector3<T> (&change)[F::kPoints], const BodyRows<Real>& rows) {
    for (int k = 0; k < FormulaSize<F>::kRows; ++k) store(block.impulse[k], impulse[k]);
    for (int i = 0; i < F::kPoints; ++i)
        write_points<Real, W>(rows.change, block.row[i], rows.dynamic_count, change[i]);
}

template <class F, class Real, int W>
[[gnu::flatten]] void solve_points(FormulaBlock<F, Real, W>* blocks, const BodyRows<Real>& rows,
                                   Real h, std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    using Size = FormulaSize<F>;
    constexpr int n = F::kPoints;
    for (std::uint32_t b = first; b < last; ++b) {
        FormulaBlock<F, Real, W>& block = blocks[b];
        auto points = gather_points<F, Real, W>(block, rows, T(h));
        LoadedItems<F, Real, W> items(block);
        if constexpr (Size::kIsLinear) {
            LinearRow<T, n> row;
            for (int i = 0; i < n; ++i) row.weight[i] = items.numbers[i];
            T c[3];
            evaluate<F, Real, W>(c, block, points.place);
            Vector3<T> sum(items.impulse[0], items.impulse[1], items.impulse[2]);
            plumb::solve_points<T, n>(points.change, items.mass, row, Vector3<T>(c[0], c[1], c[2]),
                                      Vector3<T>(items.lag[0], items.lag[1], items.lag[2]),
                                      items.soft[0], sum, T(h));
            for (int k = 0; k < 3; ++k) items.impulse[k] = sum[k];
        } else {
            plumb::solve_points<T, n, Size::kRows>(points.change, items.mass,
                                                   F::rows(points.place, items.numbers), items.lag,
                                                   items.soft, items.impulse, T(h));
        }
        store_points<F, Real, W>(block, items.impulse, points.change, rows);
    }
}

template <class F, class Real, int W>
[[gnu::flatten]] void follow_points(FormulaBlock<F, Real, W>* blocks,
                                    FormulaPushBlock<F, Real, W>* pushes,
                                    const BodyRows<Real>& rows, Real h, std::uint32_t first,
                                    std::uint32_t last) {
    using T = Number<Real, W>;
    constexpr int n = F::kPoints, m = F::kRows;
    for (std::uint32_t b = first; b < last; ++b) {
        FormulaBlock<F, Real, W>& block = blocks[b];
        FormulaPushBlock<F, Real, W>& pushed = pushes[b];
        auto points = gather_points<F, Real, W>(block, rows, T(h));
        LoadedItems<F, Real, W> items(block);
        Vector3<T> push[n - 1];
        for (int i = 0; i < 3 * (n - 1); ++i) push[i / 3][i % 3] = load(pushed.push[i]);
        F::follow(points.place, points.change, push, items.numbers, items.mass, items.impulse,
                  T(h));
        const PointRows<T, n, m> here = F::rows(points.place, items.numbers);
        T before[m];
        std::copy_n(items.impulse, m, before);
        plumb::solve_points<T, n, m>(points.change, items.mass, here, items.lag, items.soft,
                                     items.impulse, T(h));
        for (int i = 0; i < n - 1; ++i)
            for (int r = 0; r < m; ++r)
                push[i] += here.gradient[r][i + 1] * (items.impulse[r] - before[r]);
        for (int i = 0; i < 3 * (n - 1); ++i) store(pushed.push[i], push[i / 3][i % 3]);
        store_points<F, Real, W>(block, items.impulse, points.change, rows);
    }
}

template <class F, class Real, int W>
void look_at_elements(FormulaPatchBlock<F, Real, W>* blocks, Real* slopes,
                      const BodyRows<Real>& rows, Real h, std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    constexpr int n = F::kPoints, m = F::kRows;
    const T inverse_h = T(1) / T(h);
    for (std::uint32_t b = first; b < last; ++b) {
        FormulaPatchBlock<F, Real, W>& block = blocks[b];
        auto points = gather_previews<n, Real, W>(rows, block.row);
        points.template move<Real, W>(rows.change, block.row, T(h));
        T numbers[F::kNumbers], c[m];
        load_all<Real, F::kNumbers, W>(numbers, block.numbers);
        const T share = load(block.share), cosine = load(block.cosine), sine = load(block.sine);
        const PointRows<T, n, m> here = F::rows(points.place, numbers);
        const auto turned = [&](auto& of_rows) {
            if constexpr (HasAxes<F>) F::turn(of_rows, cosine, sine);
        };
        for (int r = 0; r < m; ++r) c[r] = here.c[r] * (share * inverse_h);
        turned(c);
        for (int r = 0; r < m; ++r) store(block.c[r], c[r]);
        const Vector3<T> none(T(0), T(0), T(0));
        for (int k = 0; k < n; ++k) {
            Vector3<T> slope[m];
            for (int r = 0; r < m; ++r) slope[r] = here.gradient[r][k] * share;
            turned(slope);
            for (int r = 0; r < m; r += 2)
                write_velocities<Real, W>(slopes + r / 2 * kBodyRowSize, block.slope[k],
                                          std::numeric_limits<std::int32_t>::max(),
                                          {slope[r], r + 1 < m ? slope[r + 1] : none});
        }
    }
}

template <class F, class Real, int W>
constexpr FormulaKernels<F, Real, W> kernels_of_formula() {
    FormulaKernels<F, Real, W> kernels{begin_points<F, Real, W>, solve_points<F, Real, W>, nullptr,
                                       nullptr};
    if constexpr (HasFollowing<F>) kernels.follow = follow_points<F, Real, W>;
    if constexpr (HasPatches<F>) kernels.look = look_at_elements<F, Real, W>;
    return kernels;
}

template <class Real, int W, class... F>
constexpr PointKernelsOf<FormulaList<F...>, Real, W> all_point_kernels(FormulaList<F...>) {
    return {kernels_of_formula<F, Real, W>()...};
}

}  // namespace plumb::kernels
