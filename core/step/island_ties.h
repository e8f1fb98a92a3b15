// SPDX-License-Identifier: MIT
/// What holds the islands together that are solved exactly, besides contacts: joints, links and
/// couplings, from the world's tables to rows, and back. A further kind is a class beside
/// IslandLinks and a line in each of the functions here.
#pragma once

#include "step/island_couplings.h"
#include "step/island_joints.h"
#include "step/island_links.h"
#include "world/tie.h"

#include <span>
#include <vector>

namespace plumb {

/// The ties of one island, by place in those of all.
struct IslandTieRange {
    struct Part {
        std::uint32_t first = 0, last = 0;
    };
    Part joints, links, couplings;
    std::uint32_t first_row = 0, last_row = 0;

    bool empty() const {
        return joints.first == joints.last && links.first == links.last &&
               couplings.first == couplings.last;
    }
};

class IslandTies {
public:
    void clear();

    // once a step: island by island, its ties between these two

    void begin_island(IslandTieRange& range) const;
    void end_island(IslandTieRange& range) const;

    void add(const World& world, const ContactIslands& islands, const Tie& tie);

    /// A tie of an island that has some, by which messages name it.
    Tie first_of(const IslandTieRange& range) const;

    /// Visits all ties of an island.
    template <class Visit>
    void each(const IslandTieRange& range, Visit visit) const {
        for (std::uint32_t i = range.joints.first; i < range.joints.last; ++i)
            visit(Tie{TieKind::joint, joints_.joint(i)});
        for (std::uint32_t i = range.links.first; i < range.links.last; ++i)
            visit(Tie{TieKind::link, links_.link(i)});
        for (std::uint32_t i = range.couplings.first; i < range.couplings.last; ++i)
            visit(Tie{TieKind::coupling, couplings_.coupling(i)});
    }

    // once a substep

    /// Forgets the rows of the substep before.
    void begin() { rows_.clear(); }
    /// Rows at the start of the substep, with the impulses of the one before.
    void begin(const World& world, const SubstepTime& time, IslandTieRange& range);

    /// What loads of the substep before add to the inertia of the island's bodies.
    void stiffen(const World& world, double h, const IslandTieRange& range,
                 std::span<IslandBody> bodies) const {
        for (std::uint32_t i = range.joints.first; i < range.joints.last; ++i)
            joints_.stiffen(world, h, i, bodies);
    }

    /// How far its worst joint was open then [m], [rad].
    double open_at_start(const IslandTieRange& range) const;

    /// How far it will be open, old errors included, and how fast what is immovable moves the
    /// points of joints [m/s].
    double open_at_end(const IslandTieRange& range, std::span<const Vector6d> velocity) const;
    double scripted_speed(const IslandTieRange& range) const;

    std::span<IslandRow> rows(const IslandTieRange& range) {
        return std::span(rows_).subspan(range.first_row, range.last_row - range.first_row);
    }
    std::span<IslandRow> rows() { return rows_; }

    /// Ties are not linear: asks the rows to close what is open at the preview of the velocities.
    /// Returns how far the worst is open [m], [rad].
    double ask(const IslandTieRange& range, std::span<const Vector6d> velocity,
               OldErrors old = OldErrors::closed);

    /// The same without couplings, which come to a far offset by their own.
    double ask_to_close(const IslandTieRange& range, std::span<const Vector6d> velocity,
                        OldErrors old = OldErrors::closed);

    /// Impulses of the substep, into the world's tables.
    void store_impulses(const IslandTieRange& range, std::span<const Vector6d> velocity,
                        World& world) const;

private:
    IslandJoints joints_;
    IslandLinks links_;
    IslandCouplings couplings_;
    std::vector<IslandRow> rows_;
    double h_ = 0;
};

}  // namespace plumb
