// SPDX-License-Identifier: MIT
/// The contact kernels' entry tables: one a precision, a lane width and a variant of rows.
///
/// A table is built by a translation unit of its own instruction set, and reached only through
/// `contact_kernels`, which hands out none that this processor could not run.
#pragma once

#include "kernels/pair_residual.h"
#include "schedule/contact_rows.h"

#include <cstdint>

namespace plumb {

/// A loop over the blocks [first, last). The blocks of one call share no dynamic body.
template <class Real, int W>
using ContactPass = void (*)(const ContactArrays<Real, W>& arrays, const BodyRows<Real>& bodies,
                             const PassSettings<Real>& pass, std::uint32_t first,
                             std::uint32_t last);

/// Takes the masses of the blocks' bodies from a table by row (solve/mass_table.h).
template <class Real, int W>
using MassPass = void (*)(const ContactArrays<Real, W>& arrays, const Real* masses,
                          std::uint32_t first, std::uint32_t last);

/// Finds the residuals of the blocks [first, last), and changes nothing else.
template <class Real, int W>
using ResidualPass = void (*)(PairResidual<Real, W>* residuals,
                              const ContactArrays<Real, W>& arrays, const BodyRows<Real>& bodies,
                              const PassSettings<Real>& pass, std::uint32_t first,
                              std::uint32_t last);

template <class Real, int W>
struct ContactKernels {
    MassPass<Real, W> take_masses;          // at new poses, first,
    ContactPass<Real, W> prepare;           // then this: tangents, effective masses
    ContactPass<Real, W> begin;             // once a substep: velocities at its start
    ContactPass<Real, W> warm_start;        // applies the impulses that the rows already hold
    ContactPass<Real, W> solve_velocities;  // one iteration
    ContactPass<Real, W> solve_positions;   // one iteration
    ResidualPass<Real, W> find_residuals;   // after the last
};

/// The kernels of one variant. Throws std::logic_error when this processor cannot run W lanes.
template <class Real, int W>
const ContactKernels<Real, W>& contact_kernels(ContactVariant variant);

/// Widest lanes that this processor runs: 16 (AVX-512), 8 (AVX2) or 4.
int widest_lanes();

}  // namespace plumb
