// SPDX-License-Identifier: MIT
/// The contacts that push in the factors of the elastic system.
#pragma once

#include "math/sparse_ldlt.h"
#include "world/kept_factors.h"

#include <vector>

namespace plumb {

/// The pairs (particle, row) that have blocks, sorted; rows of bodies, that of v and then that of
/// ω, are numbered from `first_row` on.
void list_pairs(const KeptFactors& made_of, std::uint32_t first_row,
                std::vector<SparseLdlt::Pair>& pairs);

/// How contacts resist a change of velocities [row of the system], times that change [J].
double stiffness_along(const KeptFactors& made_of, std::uint32_t first_row,
                       const std::vector<Vector3d>& way);

/// Adds bodies and contacts. `pairs` were told to the system from `first_pair` on. `mass`:
/// [particle], 0 of what stays.
void add_contact_stiffness(const KeptFactors& made_of, const std::vector<double>& mass,
                           std::uint32_t first_row, const std::vector<SparseLdlt::Pair>& pairs,
                           std::size_t first_pair, SparseLdlt& system);

}  // namespace plumb
