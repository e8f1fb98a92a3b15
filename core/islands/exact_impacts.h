// SPDX-License-Identifier: MIT
/// Collisions (contacts/impacts.h) of small islands that sweeps do not settle, or that are solved
/// exactly anyway: compression and restitution, each solved until its laws hold.
///
/// What sweeps leave of an approach becomes overlap. Where a light body lies between heavy ones
/// that is much in a substep, and its push-out is energy from nowhere.
#pragma once

#include "contacts/contact_sums.h"
#include "contacts/impacts.h"
#include "effects/plan.h"
#include "islands/island_columns.h"
#include "islands/island_solver.h"
#include "islands/island_system.h"
#include "islands/own_motion.h"
#include "world/world.h"

#include <vector>

namespace plumb {

/// Of islands of at most so many bodies.
inline constexpr std::uint32_t kMostExactlyHit = 64;

class ExactImpacts {
public:
    explicit ExactImpacts(const Plan& plan) : columns_(plan) {}

    /// Once for all collisions that begin in a substep.
    void begin() { borne_.clear(), hit_.clear(); }

    /// Writes what the collision of an island changes into `impacts`. `island`: its index among
    /// those that collide; h: the substep [s].
    void solve(World& world, Impacts& impacts, std::size_t island, double h);

    /// After Impacts::take: marks the contacts that part, and adds what all bear to the sums, if
    /// there are any.
    void end(World& world, const Impacts& impacts, ContactSums* sums) const;

private:
    void fill(const World& world, const Impacts& impacts, std::size_t island);
    void ask(const World& world, const Impacts& impacts, double h);
    bool give_back(World& world);
    void settle();
    bool bears_most() const;
    void hold_back(const Settings& settings);
    double work_of_drivers() const;
    void bound_energy(double of_compression);

    struct State {
        std::vector<Vector6d> velocity;  // [body]
        std::vector<Vector6d> impulse;   // [point]
    };
    void keep(State& state) const;
    void take(const State& state);
    Island all() { return {columns_.bodies, columns_.velocity, columns_.points, {}}; }

    // of one island
    IslandColumns columns_;
    IslandSystem::Pattern pattern_;
    IslandSystem system_;
    IslandSystem::Spare spare_;
    IslandSolver solver_;
    double speed_ = 0;  // at which its contacts approach [m/s]
    struct Driver {
        std::size_t point;
        OwnMotion own;
    };
    std::vector<Driver> drivers_;  // what touches it and moves by itself
    bool is_jammed_ = false;       // between them and what stays
    State before_, compressed_;
    struct Given {
        std::size_t point;
        double impulse;  // [N s]
    };
    std::vector<Given> given_;  // by restitution

    // of all
    struct Borne {
        std::size_t island;
        std::uint32_t contact;
        double normal;  // [N s]
        Vector3d friction;
    };
    std::vector<Borne> borne_;
    std::vector<std::size_t> hit_;  // contacts
};

}  // namespace plumb
