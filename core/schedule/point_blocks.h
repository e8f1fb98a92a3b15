// SPDX-License-Identifier: MIT
/// Memory of the constraints among particles: W of them side by side.
#pragma once

#include "schedule/contact_rows.h"

namespace plumb {

/// Rows of the formula's points, what it knows of its item, and what it has pushed so far.
/// `Size`: FormulaSize of the formula.
template <class Size, int Points, class Real, int W>
struct alignas(64) PointBlock {
    std::int32_t row[Points][W];  // in the velocity table; the row of zeros in empty lanes
    // where the start of the substep takes the points but the first, against that [m]
    Real apart[3 * (Points - 1)][W];
    Real inverse_mass[Points][W];          // [1/kg]
    Real numbers[Size::kNumbers][W];       // of the item at rest
    Real softness[Size::kCompliances][W];  // point_softness()
    Real damped[W];                        // point_lag()
    Real lag[Size::kRows][W];              // the same of C at the start of the substep
    Real impulse[Size::kRows][W];          // summed over the substep
};

/// What W constraints have pushed into each of their points except the first, which took the
/// opposite of their sum [N s].
template <int Points, class Real, int W>
struct alignas(64) PushBlock {
    Real push[3 * (Points - 1)][W];
};

/// Elements of patches, side by side: what a cycle takes of them, and C/h, in the axes of the patch
/// and times `share`.
template <class Size, int Points, class Real, int W>
struct alignas(64) PatchBlock {
    std::int32_t row[Points][W];      // in the velocity table; the row of zeros in empty lanes
    Real numbers[Size::kNumbers][W];  // of the element at rest
    Real share[W], cosine[W], sine[W];
    Real c[Size::kRows][W];
    std::int32_t slope[Points][W];  // where its gradients go, in rows of eight numbers
};

}  // namespace plumb
