// SPDX-License-Identifier: MIT
/// What a substep asks of the contacts and ties of islands that are solved exactly, and the most
/// that these may bear.
#pragma once

#include "constraints/contact.h"
#include "islands/island_choice.h"
#include "islands/island_columns.h"
#include "world/world.h"

namespace plumb {

/// Of one substep, at its start.
class IslandDemands {
public:
    IslandDemands(const World& world, const IslandChoice& choice, const PushOut& push_out,
                  IslandColumns& columns)
        : world_(world), choice_(choice), push_out_(push_out), columns_(columns), h_(columns.h) {}

    /// Sets what is wanted of the contacts and ties of an island, the most that they bear, and what
    /// it is in this substep. Returns how many contacts overlap deeper than what is pushed out.
    std::uint32_t ask(ExactIsland& island);

private:
    double open_at_start(const ExactIsland& island);
    double torn_from(const ExactIsland& island) const;
    double speed_of(const ExactIsland& island) const;
    double thrust_of(const ExactIsland& island) const;
    double strongest(const ExactIsland& island) const;
    void bound_rows(const ExactIsland& island, double most);
    bool ask(const ExactIsland& island, std::size_t point);
    static bool stays(const ExactIsland& island);
    double asked_along(const ExactIsland& island, std::size_t point, double gap);
    Vector3d asked_across(const ExactIsland& island, std::size_t point) const;
    double closing_velocity(double gap) const;

    const World& world_;
    const IslandChoice& choice_;
    const PushOut& push_out_;
    IslandColumns& columns_;
    double h_;  // the substep [s]
};

}  // namespace plumb
