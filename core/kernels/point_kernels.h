// SPDX-License-Identifier: MIT
/// The kernels of constraints among particles, over blocks that share no particle.
#pragma once

#include "constraints/formulas.h"
#include "schedule/point_blocks.h"

namespace plumb {

template <class F, class Real, int W>
using FormulaBlock = PointBlock<FormulaSize<F>, F::kPoints, Real, W>;

template <class F, class Real, int W>
using FormulaPatchBlock = PatchBlock<FormulaSize<F>, F::kPoints, Real, W>;
template <class F, class Real, int W>
using FormulaPushBlock = PushBlock<F::kPoints, Real, W>;
/// Rows of eight numbers that the gradient of a formula takes at a point: two rows of C in each.
template <class F>
inline constexpr int kSlopeRows = (FormulaSize<F>::kRows + 1) / 2;

template <class F, class Real, int W>
struct FormulaKernels {
    using Pass = void (*)(FormulaBlock<F, Real, W>* blocks, const BodyRows<Real>& rows, Real h,
                          std::uint32_t first, std::uint32_t last);
    Pass begin;  ///< once a substep of length h [s]: nothing pushed, and C at its start
    Pass solve;  ///< one iteration
    /// The same where what was pushed turns with its elements; null where a formula cannot.
    void (*follow)(FormulaBlock<F, Real, W>* blocks, FormulaPushBlock<F, Real, W>* pushes,
                   const BodyRows<Real>& rows, Real h, std::uint32_t first, std::uint32_t last);
    /// C and its gradient at the end of the substep as things stand; null where a formula has no
    /// patches.
    void (*look)(FormulaPatchBlock<F, Real, W>* blocks, Real* slopes, const BodyRows<Real>& rows,
                 Real h, std::uint32_t first, std::uint32_t last);
};

/// The kernels of all formulas of a list.
template <class List, class Real, int W>
struct PointKernelsOf;
template <class... F, class Real, int W>
struct PointKernelsOf<FormulaList<F...>, Real, W> : FormulaKernels<F, Real, W>... {};

template <class Real, int W>
using PointKernels = PointKernelsOf<Formulas, Real, W>;

/// Throws std::logic_error when this processor cannot run W lanes.
template <class Real, int W>
const PointKernels<Real, W>& point_kernels();

}  // namespace plumb
