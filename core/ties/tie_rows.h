// SPDX-License-Identifier: MIT
/// What holds the bodies of systems together that are solved as a whole, besides contacts: joints,
/// links and couplings, from the world's tables to rows, and back. A further kind is a class beside
/// TiedLinks and a line in each of the functions here.
#pragma once

#include "ties/tied_couplings.h"
#include "ties/tied_joints.h"
#include "ties/tied_links.h"
#include "world/tie.h"

#include <span>
#include <vector>

namespace plumb {

/// The ties of one system, by place in those of all.
struct TieRange {
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

class TieRows {
public:
    void clear();

    // once a step: system by system, its ties between these two

    void begin_range(TieRange& range) const;
    void end_range(TieRange& range) const;

    /// `at`: its bodies among those of the system.
    void add(const World& world, const Tie& tie, const TiedBodies& at);

    /// A tie of a system that has some, by which messages name it.
    Tie first_of(const TieRange& range) const;

    /// Visits all ties of a system.
    template <class Visit>
    void each(const TieRange& range, Visit visit) const {
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
    void begin(const World& world, const SubstepTime& time, TieRange& range);

    /// What loads of the substep before add to the inertia of the system's bodies.
    void stiffen(const World& world, double h, const TieRange& range,
                 std::span<SolvedBody> bodies) const {
        for (std::uint32_t i = range.joints.first; i < range.joints.last; ++i)
            joints_.stiffen(world, h, i, bodies);
    }

    /// How far its worst joint was open then [m], [rad].
    double open_at_start(const TieRange& range) const;

    /// How far it will be open, old errors included, and how fast what is immovable moves the
    /// points of joints and links [m/s].
    double open_at_end(const TieRange& range, std::span<const Vector6d> velocity) const;
    double scripted_speed(const TieRange& range) const;

    std::span<TieRow> rows(const TieRange& range) {
        return std::span(rows_).subspan(range.first_row, range.last_row - range.first_row);
    }
    std::span<TieRow> rows() { return rows_; }
    std::span<const TieRow> rows() const { return rows_; }

    /// Ties are not linear: asks the rows to close what is open at the preview of the velocities.
    /// Returns how far the worst is open [m], [rad].
    double ask(const TieRange& range, std::span<const Vector6d> velocity,
               OldErrors old = OldErrors::closed);

    /// The same without couplings, which come to a far offset by their own.
    double ask_to_close(const TieRange& range, std::span<const Vector6d> velocity,
                        OldErrors old = OldErrors::closed);

    /// Impulses of the substep, into the world's tables.
    void store_impulses(const TieRange& range, std::span<const Vector6d> velocity,
                        World& world) const;

private:
    TiedJoints joints_;
    TiedLinks links_;
    TiedCouplings couplings_;
    std::vector<TieRow> rows_;
    double h_ = 0;
};

}  // namespace plumb
