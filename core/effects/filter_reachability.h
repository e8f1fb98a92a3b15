// SPDX-License-Identifier: MIT
/// Which bodies can ever touch another, by their filters.
#pragma once

#include "world/world.h"

#include <cstddef>

namespace plumb {

/// How many bodies have a shape and a filter that lets them meet at least one other, one of the two
/// dynamic. Pairs that are excluded one by one count as if they could meet.
std::size_t collidable_bodies(const World& world);

}  // namespace plumb
