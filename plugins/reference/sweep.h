// SPDX-License-Identifier: MIT
/// The reference's broad phase: sort along one axis and sweep.
#pragma once

#include "manifold/body_table.h"

namespace plumb::reference {

/// All pairs of parts whose bounds overlap and that are to be tested, sorted. Reuses the memory of
/// `pairs`.
void find_pairs(std::vector<PartPair>& pairs, const BodyTable& table);

}  // namespace plumb::reference
