// SPDX-License-Identifier: MIT
/// Bodies that sleep (Settings::sleep_speed): what rested for long enough is immovable until
/// something disturbs it, and costs a step next to nothing.
///
/// A body falls asleep with all that it touches or is tied to, directly or through others, and
/// wakes with all of them. While it sleeps it has no row in the velocity table, and the contacts
/// between bodies of which none moves lie aside with all that they remember, so that what wakes
/// goes on as it was.
#pragma once

#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// Whether a body moves by itself unless it sleeps.
constexpr bool is_movable(Motion motion) {
    return motion == Motion::dynamic || motion == Motion::asleep;
}

/// What a body is while it does not sleep.
constexpr Motion awake(Motion motion) {
    return motion == Motion::asleep ? Motion::dynamic : motion;
}

/// Whether a body is where a step would leave it, whatever touches it: it is fixed, it sleeps, or
/// it is kinematic, at rest and without a script.
bool is_still(const Bodies& bodies, std::size_t body);

/// Changes the motion of a movable body, and what it resists forces with.
void set_asleep(Bodies& bodies, std::size_t body, bool asleep);

/// They fall asleep together. Contacts and rows are out of date (sort_contacts, assign_rows).
void put_to_sleep(Bodies& bodies, const std::vector<std::uint32_t>& island);

/// Wakes a body if it sleeps, with all that fell asleep with it. Contacts and rows are out of date.
void wake(Bodies& bodies, std::uint32_t body);

/// The same for what touches a body, is near it or joined to it, and for itself: before it is
/// moved, once it came, or is to go. What is awake there has not rested. Returns whether anything
/// woke.
bool wake_near(World& world, std::uint32_t body);

/// Puts the contacts of bodies that are both still aside, and those of which one moves now among
/// those of the step.
void sort_contacts(World& world);

}  // namespace plumb
