// SPDX-License-Identifier: MIT
/// A world's shapes, handed to a collider. What the collider, called `collider`, refuses is thrown
/// as ColliderError.
#pragma once

#include <plumb/proximity.h>

#include "world/body_row.h"
#include "world/world.h"

#include <string>

namespace plumb {

/// What a row of the table says of its body's shape.
BodyRow shape_row(const Bodies& bodies, std::uint32_t slot);

/// Adds every body that has a shape, in its slot, and excludes the pairs that are kept apart.
/// The world's shapes must outlive the collider's use of them. Where the collider refuses one, or
/// the raw contacts that the settings ask for, it is left without any.
void add_bodies(Proximity& proximity, const World& world, const std::string& collider);

/// Adds one body, if it has a shape, in its coming slot.
void add_body(Proximity& proximity, const World& world, std::uint32_t slot, const BodyRow& row,
              const std::string& collider);

/// Removes one body, if it has a shape.
void remove_body(Proximity& proximity, const World& world, std::uint32_t slot,
                 const std::string& collider);

/// Excludes a pair of bodies, given as pair_key, if both have shapes, or lets it in again.
void exclude_pair(Proximity& proximity, const World& world, std::uint64_t key, bool excluded,
                  const std::string& collider);

}  // namespace plumb
