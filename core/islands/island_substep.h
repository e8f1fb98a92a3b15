// SPDX-License-Identifier: MIT
/// The solution of one island in one substep, and what is done where that does not keep its laws:
/// ties that stay open are held or closed with what energy there is (island_closing.cpp), and
/// nothing gains energy that nothing gives it (island_energy.cpp).
#pragma once

#include "islands/island_columns.h"
#include "islands/island_solver.h"
#include "scene/settings.h"

#include <algorithm>
#include <span>

namespace plumb {

class IslandSubstep {
public:
    IslandSubstep(const World& world, IslandColumns& columns, IslandSolver& solver,
                  ExactIsland& island)
        : bodies_(world.bodies),
          settings_(world.settings),
          ties_(columns.ties),
          solver_(solver),
          island_(island),
          all_(columns.all_of(island)),
          start_(bodies_in(columns.start, island)),
          shift_(bodies_in(columns.shift, island)),
          opening_(points_in(columns.opening, island)),
          parting_(points_in(columns.parting, island)),
          h_(columns.h) {}

    /// Changes the impulses and velocities of the island, and says in it what came of that.
    void solve();

private:
    void open_apart();
    void sweep();
    void solve_exactly();
    bool close();
    static bool is_finite(std::span<const Vector6d> velocities);
    bool solve_system(IslandEffort effort);
    void give_up_if_in_vain();
    void turn_back();

    /// Back to the velocities of the start; impulses stay.
    void begin_anew() { std::copy(start_.begin(), start_.end(), all_.velocity.begin()); }
    /// What its ties want at the present velocities, and how far they are open.
    void ask() { island_.open = ties_.ask(island_.ties, all_.velocity); }

    // ties that stay open
    void judge_ties(bool was_solved);
    bool is_pulled_apart() const;
    bool is_flung() const;
    void give_way();
    void hold_torn();
    void draw_together();
    void close_gently();
    void brake_torn();

    // energy
    double energy_at_start() const { return kinetic_energy(all_.bodies, start_); }
    double energy() const { return kinetic_energy(all_.bodies, all_.velocity); }
    bool gains(double share = 0) const { return !(energy() <= (1 + share) * energy_at_start()); }
    bool rests(double before, double whole) const;
    void bound_energy();
    void bound_swept_energy();
    void bound_speed();
    void keep(double share);

    const Bodies& bodies_;
    const Settings& settings_;
    TieRows& ties_;
    IslandSolver& solver_;
    ExactIsland& island_;
    Island all_;  // its bodies, points and rows
    std::span<const Vector6d> start_;
    std::span<Vector6d> shift_;
    std::span<const double> opening_, parting_;
    double h_;  // the substep [s]
};

}  // namespace plumb
