// SPDX-License-Identifier: MIT
/// The joints of islands that are solved exactly: from the world's tables to rows, and back.
///
/// Levers are those of the start of a substep, which keeps momentum and energy (constraints/
/// joint_lever.h). Rows are linear and joints are not: after each solution the rows are asked to
/// close what is still open at the preview poses.
#pragma once

#include "constraints/axis_drive.h"
#include "constraints/joint_rows.h"
#include "step/island.h"
#include "step/substep_time.h"
#include "world/world.h"

#include <span>
#include <vector>

namespace plumb {

class IslandJoints {
public:
    void clear();

    /// Adds a joint of an island, in which its bodies have these indices or are kImmovable.
    void add(const World& world, std::uint32_t joint, std::uint32_t a, std::uint32_t b);

    std::uint32_t size() const { return static_cast<std::uint32_t>(joints_.size()); }
    /// Index in the world's table.
    std::uint32_t joint(std::uint32_t i) const { return joints_[i].joint; }

    /// Once a substep: rows at its start, with the impulses of the one before.
    void begin(const World& world, const SubstepTime& time);

    // of the joints [first, last), those of one island

    std::span<IslandRow> rows(std::uint32_t first, std::uint32_t last);

    /// Asks the rows to close what is open at the preview of the velocities. Returns how far the
    /// worst is open [m], [rad].
    double ask(std::uint32_t first, std::uint32_t last, std::span<const Vector6d> velocity);

    /// Impulses of the substep, into the world's table.
    void store_impulses(std::uint32_t first, std::uint32_t last, std::span<const Vector6d> velocity,
                        JointTable& table) const;

private:
    /// All that drives one axis of a joint.
    struct Axis {
        std::uint32_t first, last;  ///< of JointTable::drives
        AxisDrive drive;
    };
    struct Member {
        std::uint32_t joint, a, b;            ///< in the world's table; of the island
        std::uint32_t first_axis, last_axis;  ///< of axes_
        std::uint32_t first_row = 0, first_axis_row = 0, last_row = 0;
        Velocity<double> held_a, held_b;  ///< of what is immovable
        JointGeometry<double> geometry;
        double deferred[6];  ///< old error that is left for later [m], [rad]
    };

    void begin(const World& world, const SubstepTime& time, Member& member);
    void add_axis_row(const World& world, const SubstepTime& time, const Member& member,
                      std::uint32_t axis);
    void add_row(const World& world, const Member& member, const Vector3d& along,
                 const Vector3d& turn_a, const Vector3d& turn_b);
    double ask(Member& member, std::span<const Vector6d> velocity);

    std::vector<Member> joints_;
    std::vector<Axis> axes_;
    std::vector<IslandRow> rows_;  // by joint: those that it takes away, then its axes
    double h_ = 0;
};

}  // namespace plumb
