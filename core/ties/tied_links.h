// SPDX-License-Identifier: MIT
/// The links (constraints/link.h) of systems that are solved as a whole, between their bodies and,
/// where particles are part of the system, these. Impulses act along the line of the start of a
/// substep, or along all three axes where points are joined, and the rows are asked to close what
/// is still open at the preview poses, as those of joints are.
#pragma once

#include "constraints/link.h"
#include "constraints/substep_time.h"
#include "ties/tied_bodies.h"

#include <span>
#include <vector>

namespace plumb {

class TiedLinks {
public:
    void clear() { links_.clear(); }

    /// Adds a link; `at`: its bodies in the order of `each_body` (world/tie.h), among those of the
    /// system, or kImmovable.
    void add(std::uint32_t link, const TiedBodies& at);

    std::uint32_t size() const { return static_cast<std::uint32_t>(links_.size()); }
    /// Index in the world's table.
    std::uint32_t link(std::uint32_t i) const { return links_[i].link; }

    /// Once a substep: adds the rows of a link at its start, with the impulse of the one before.
    void begin(const World& world, const SubstepTime& time, std::uint32_t i,
               std::vector<TieRow>& rows);

    /// Asks its rows to close what is open at the preview of the velocities. Returns how far it is
    /// open [m].
    double ask(std::uint32_t i, std::span<const Vector6d> velocity, double h,
               std::vector<TieRow>& rows) const;

    /// How fast what is immovable moves the points of a link [m/s].
    double scripted_speed(std::uint32_t i) const;

    /// The impulse of the substep, into the world's table.
    void store_impulses(std::uint32_t i, const std::vector<TieRow>& rows,
                        std::vector<Link>& links) const;

private:
    struct Member {
        std::uint32_t link, a, b;  ///< in the world's table; of the system
        bool joins;
        LinkedPoint at_a, at_b;
        Velocity<double> scripted_a, scripted_b;  ///< of what is immovable
        Vector3d apart;                           ///< a − b, at the start [m]
        Vector3d arm_b;                           ///< of what acts on b [m]
        double lag;                               ///< see point_lag
        std::uint32_t first_row = 0, last_row = 0;
        Vector3d line[3];  ///< [row] along which it acts on a
        double rest[3];    ///< [row] length that it keeps [m]
    };
    static void add_row(Member& member, const Link& link, const Vector3d& line, double rest,
                        double softness, std::vector<TieRow>& rows);
    static Vector3d apart_at_end(const Member& member, std::span<const Vector6d> velocity,
                                 double h);

    std::vector<Member> links_;
};

}  // namespace plumb
