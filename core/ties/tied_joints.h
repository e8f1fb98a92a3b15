// SPDX-License-Identifier: MIT
/// The joints of systems that are solved as a whole: from the world's tables to rows, and back.
///
/// Levers are those of the start of a substep, which keeps momentum and energy (constraints/
/// joint_lever.h), but where that would swing light bodies under a heavy load ever faster. Rows are
/// linear and joints are not: after each solution the rows are asked to close what is still open at
/// the preview poses.
#pragma once

#include "constraints/axis_drive.h"
#include "constraints/joint_rows.h"
#include "constraints/substep_time.h"
#include "ties/tied_bodies.h"

#include <span>
#include <vector>

namespace plumb {

/// What becomes of the errors with which a substep begins.
enum class OldErrors : std::uint8_t {
    closed,  ///< as fast as recovery_speed allows
    kept     ///< and what is immovable does not move
};

class TiedJoints {
public:
    void clear();

    /// Adds a joint; `at`: its bodies in the order of `each_body` (world/tie.h), among those of the
    /// system, or kImmovable.
    void add(const World& world, std::uint32_t joint, const TiedBodies& at);

    std::uint32_t size() const { return static_cast<std::uint32_t>(joints_.size()); }
    /// Index in the world's table.
    std::uint32_t joint(std::uint32_t i) const { return joints_[i].joint; }

    /// Once a substep: adds the rows of a joint at its start, with the impulses of the one before.
    void begin(const World& world, const SubstepTime& time, std::uint32_t i,
               std::vector<TieRow>& rows);

    /// Its load of the substep before turns with the levers of heavily loaded bodies (constraints/
    /// joint_lever.h): what that changes of their turns acts as inertia about them.
    void stiffen(const World& world, double h, std::uint32_t i, std::span<SolvedBody> bodies) const;

    /// How far it was open then, where it does not give [m], [rad].
    double open_at_start(std::uint32_t i) const;

    /// Asks its rows to close what is open at the preview of the velocities, but for what is left
    /// of old errors: some for later, or all. Returns how far it is open [m], [rad].
    double ask(std::uint32_t i, std::span<const Vector6d> velocity, double h, OldErrors old,
               std::vector<TieRow>& rows) const;

    /// How far it is open at the preview of the velocities, old errors included, where it does not
    /// give [m], [rad]; and how fast what is immovable moves its point [m/s].
    double open_at_end(std::uint32_t i, std::span<const Vector6d> velocity, double h) const;
    double scripted_speed(std::uint32_t i) const;

    /// Impulses of the substep, into the world's table.
    void store_impulses(std::uint32_t i, std::span<const Vector6d> velocity,
                        const std::vector<TieRow>& rows, JointTable& table) const;

private:
    /// All that drives one axis of a joint.
    struct Axis {
        std::uint32_t first, last;  ///< of JointTable::drives
        AxisDrive drive;
    };
    struct Member {
        std::uint32_t joint, a, b;                        ///< in the world's table; of the system
        std::uint32_t first_axis, last_axis;              ///< of axes_
        std::uint32_t first_row = 0, first_axis_row = 0;  ///< those it takes away, then its axes
        Velocity<double> scripted_a, scripted_b;          ///< of what is immovable
        JointGeometry<double> geometry;
        Vector3d load;       ///< what it bore in the substep before, on a [N s]
        double old[6];       ///< errors at the start, where it does not give [m], [rad]
        double deferred[6];  ///< what is left of them for later [m], [rad]
    };

    TieRow axis_row(const World& world, const SubstepTime& time, const Member& member,
                    Axis& axis) const;

    std::vector<Member> joints_;
    std::vector<Axis> axes_;
};

}  // namespace plumb
