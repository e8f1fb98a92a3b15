// SPDX-License-Identifier: MIT
/// The table of contacts from one detection to the next: those of pairs that were kept stay where
/// they are, or move up or down together, and are brought to the poses now; only the others are
/// replaced.
///
/// Between the two calls, what was detected (ContactTable::fresh) takes over the memory of what is
/// about to go.
#pragma once

#include "world/world.h"

namespace plumb {

/// Finds which contacts stay and which come, and lists their pairs. Returns how many were detected
/// of pairs that were kept, and are left out.
std::uint32_t find_moves(World& world);

/// How many contacts there will be.
std::uint32_t contacts_to_be(const KeptContacts& kept);

/// Puts what was detected, with its memory, among what was kept.
void put_in(World& world);

}  // namespace plumb
