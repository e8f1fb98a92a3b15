// SPDX-License-Identifier: MIT
/// An island that is solved exactly, or swept beside those that are: its part of the columns, and
/// what is known of it. Its system is kept from step to step, for as long as its pattern stays.
#pragma once

#include "islands/island_account.h"
#include "islands/island_effort.h"
#include "islands/island_system.h"
#include "ties/tie_rows.h"

#include <cstdint>

namespace plumb {

/// An island is open where a tie of it is by more than so many tolerances.
inline constexpr double kAjar = 100;

struct ExactIsland {
    // where it stands in IslandColumns
    std::uint32_t first_body, last_body, first_point, last_point;
    TieRange ties;

    IslandSystem::Pattern pattern;
    IslandSystem system;

    // once a step: what it is
    bool is_large;         ///< beyond Settings::exact_islands
    bool is_meshed;        ///< by ties that others only iterate, and nothing drives it
    bool is_driven;        ///< kinematic bodies move it
    bool flies;            ///< it touches and hangs by nothing that is immovable
    bool gains_nothing;    ///< no lid, motor or spring does work on it
    bool may_be_disputed;  ///< see island_effort.h
    bool may_give_up;      ///< its joints, where they stay open: sweeps do no worse
    bool moves;            ///< a heap (island_account.h), at the start of the step,
    bool moved_on;         ///< and sweeps did not bring it to rest

    // what is done for it in this step
    IslandEffort effort;
    std::uint8_t settling;  ///< steps that are left, see island_effort.h
    std::uint8_t disputed;  ///< the same
    double overlap;         ///< of all its contacts [m], if it may be disputed
    double overlap_before;  ///< the same when it began to be opened apart [m]
    bool is_deep;           ///< some of it overlaps too deeply for an exact solution
    bool splits;            ///< what is swept is opened apart from velocities
    bool opens;             ///< the same of a heap that moves, and something overlaps by much

    // what came of that in this step
    IslandAccount account;
    bool stirred;   ///< sweeps left more than what stays as it is
    bool given_up;  ///< its ties could not be closed

    // in this substep
    double speed;   ///< at which its contacts and ties would part [m/s]
    bool bounces;   ///< a contact of it does
    bool parts;     ///< at a speed that may be too much (IslandColumns::parting)
    bool was_open;  ///< at its start
    bool was_torn;  ///< the same, so far that it is torn
    bool solved;
    double open;  ///< the worst tie [m], [rad]
    double owed;  ///< of the energy lent to it [J]

    std::uint32_t body_count() const { return last_body - first_body; }
    std::uint32_t point_count() const { return last_point - first_point; }

    void begin_dispute() {
        disputed = kDisputed;
        overlap_before = overlap;
    }
};

}  // namespace plumb
