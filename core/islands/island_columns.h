// SPDX-License-Identifier: MIT
/// The bodies, contacts and ties of the islands that are solved exactly, one island after another:
/// from the world's tables to columns, and back.
#pragma once

#include "contacts/contact_sums.h"
#include "effects/plan.h"
#include "islands/exact_island.h"
#include "islands/island.h"
#include "ties/tie_rows.h"
#include "world/world.h"

#include <span>
#include <vector>

namespace plumb {

/// The bodies, or the points, of an island in a column.
template <class Column>
auto bodies_in(Column& column, const ExactIsland& island) {
    return std::span(column).subspan(island.first_body, island.body_count());
}
template <class Column>
auto points_in(Column& column, const ExactIsland& island) {
    return std::span(column).subspan(island.first_point, island.point_count());
}

struct IslandColumns {
    explicit IslandColumns(const Plan& plan);

    // once a step

    void clear();
    /// Adds a contact; `a` and `b`: bodies of its island, or kImmovable.
    void add_point(const World& world, std::uint32_t contact, std::uint32_t a, std::uint32_t b);
    /// When all islands are in: as many velocities as there are bodies.
    void size_velocities();
    /// The impulses that the contacts of an island remember of the step before.
    void take_memory(const World& world, const ExactIsland& island);

    // once a substep, and the first of these at the start of a step, too

    /// Inertia and arms at the poses now, and what follows from them.
    void take_geometry(const World& world);
    /// Velocities at the start of a substep of length h [s], forces included.
    void take_velocities(const World& world, double h);
    void forget_impulses();
    /// The impulses that the substep starts from, to the velocities of an island.
    void apply_impulses(const ExactIsland& island);

    /// Adds what the substep changed to the bodies' velocities.
    void give_changes(Bodies& bodies) const;
    /// Whether bodies of an island are shifted; and shifts them.
    bool shifts(const ExactIsland& island) const;
    void give_shifts(Bodies& bodies, const ExactIsland& island) const;
    /// Adds what the contacts bear.
    void add_impulses(ContactSums& sums) const;

    /// After the last substep: what the contacts remember for the next step.
    void store_impulses(ContactTable& table) const;

    /// As its solver sees it.
    Island all_of(const ExactIsland& i) {
        return {bodies_in(bodies, i), bodies_in(velocity, i), points_in(points, i),
                ties.rows(i.ties)};
    }

    bool has_friction, resists_rolling;
    double h = 0;  ///< the substep [s]
    std::vector<SolvedBody> bodies;
    std::vector<Vector6d> start;          ///< [body] velocities without impulses,
    std::vector<Vector6d> velocity;       ///< and now
    std::vector<Vector6d> shift;          ///< [body] beside that, as a velocity over the substep
    std::vector<Vector6d> sum;            ///< [body] of impulses, or memory for velocities
    std::vector<std::uint32_t> contacts;  ///< [point] in the contact table
    std::vector<IslandPoint> points;
    std::vector<std::uint8_t> locked;  ///< [point] whether it is pushed out no more
    std::vector<double> opening;       ///< [point] speed at which it is opened apart [m/s]
    std::vector<double> parting;       ///< [point] of the speed asked for, what may be too much
    TieRows ties;

private:
    void take_geometry(const World& world, IslandPoint& point, std::uint32_t contact) const;
    void forget_what_whirls(const ExactIsland& island);
};

}  // namespace plumb
