// SPDX-License-Identifier: MIT
/// Keeps the angular momentum of bodies that joints hold together and that hang by nothing, alone
/// or with what they touch, where iterations or trees solve them (solve/free_turn.h).
#pragma once

#include "schedule/contact_islands.h"
#include "solve/free_turn.h"
#include "solve/island_residuals.h"
#include "solve/velocity_table.h"

#include <limits>
#include <vector>

namespace plumb {

template <class Real>
class FreeIslands {
public:
    /// Once a step, before the other. What touches particles is left alone.
    void load(const World& world, const std::vector<BodyPair>& pairs) {
        free_.clear();
        if (world.joints.size() == 0 || world.particles.size() > 0) return;
        ties_.clear();
        add_tied_rows(world, ties_);
        islands_.find(pairs, ties_, 0, world.dynamic_count);
        held_.assign(islands_.islands().size(), 0);
        for (const BodyPair& pair : pairs) note_holder(world, pair);
        for (const BodyPair& tie : ties_) note_holder(world, tie);
        for (std::size_t i = 0; i < held_.size(); ++i) {
            const ContactIsland& island = islands_.islands()[i];
            if (!held_[i] && island.first_tie < island.last_tie) free_.push_back(island);
        }
    }

    bool empty() const { return free_.empty(); }

    /// After an iteration of joints; `bodies`: their rows. Returns whether anything is turned.
    bool turn_back(const World& world, const BodyRows<Real>& bodies) const {
        bool turned = false;
        for (const ContactIsland& island : free_) {
            const RigidMotion turn = plumb::turn_back(world.bodies, kRounding, [&](auto visit) {
                each_row(island, [&](std::int32_t row) {
                    const Velocity<Real> x = velocity_in(bodies.change, row);
                    visit(world.body_of_row[at(row)],
                          {x.v.template cast<double>(), x.w.template cast<double>()});
                });
            });
            if (turn.is_rest()) continue;
            turned = true;
            each_row(island, [&](std::int32_t row) {
                Velocity<Real> x = velocity_in(bodies.change, row);
                const Velocity<double> more = turn.of(world.bodies, world.body_of_row[at(row)]);
                x.v += more.v.template cast<Real>(), x.w += more.w.template cast<Real>();
                put_velocity(bodies.change, row, x);
            });
        }
        return turned;
    }

private:
    /// What is missing by more than this share is not rounding.
    static constexpr double kRounding = 4 * std::numeric_limits<Real>::epsilon();

    static std::size_t at(std::int32_t row) { return static_cast<std::size_t>(row); }

    template <class Visit>
    void each_row(const ContactIsland& island, Visit visit) const {
        for (std::uint32_t i = island.first_body; i < island.last_body; ++i)
            visit(islands_.bodies()[i]);
    }

    /// What is immovable holds the island of the other body of a pair.
    void note_holder(const World& world, const BodyPair& pair) {
        const auto moves = [&](std::int32_t row) { return row < world.dynamic_count; };
        if (moves(pair.row_a) == moves(pair.row_b)) return;
        const std::uint32_t island =
            islands_.island_of()[at(moves(pair.row_a) ? pair.row_a : pair.row_b)];
        if (island < held_.size()) held_[island] = 1;
    }

    std::vector<BodyPair> ties_;
    ContactIslands islands_;
    std::vector<std::uint8_t> held_;  // [island]
    std::vector<ContactIsland> free_;
};

}  // namespace plumb
