// SPDX-License-Identifier: MIT
/// The couplings of joints (ties/coupling_row.h) of systems that are solved as a whole.
#pragma once

#include "constraints/substep_time.h"
#include "ties/coupling_row.h"
#include "ties/tied_bodies.h"

#include <span>
#include <vector>

namespace plumb {

class TiedCouplings {
public:
    void clear() { couplings_.clear(); }

    /// Adds a coupling; `at`: its bodies in the order of `each_body` (world/tie.h), among those of
    /// the system, or kImmovable.
    void add(const World& world, std::uint32_t coupling, const TiedBodies& at);

    std::uint32_t size() const { return static_cast<std::uint32_t>(couplings_.size()); }
    /// Index in the world's table.
    std::uint32_t coupling(std::uint32_t i) const { return couplings_[i].coupling; }

    /// Once a substep: adds its row at the start, with the impulse of the one before.
    void begin(const World& world, const SubstepTime& time, std::uint32_t i,
               std::vector<TieRow>& rows);

    /// How far the coupling is from what its row asks for at the end of the substep [m], [rad]. It
    /// is linear, and asks for the same all along.
    double ask(std::uint32_t i, std::span<const Vector6d> velocity, double h,
               std::vector<TieRow>& rows) const;

    /// The impulse of the substep, into the world's table.
    void store_impulses(std::uint32_t i, const std::vector<TieRow>& rows,
                        std::vector<JointCoupling>& couplings) const;

private:
    struct Member {
        std::uint32_t coupling;  ///< in the world's table
        TiedBodies body, at;     ///< of both joints: of the world, of the system
        std::uint32_t row = 0;
        double deferred = 0;
    };
    std::vector<Member> couplings_;
};

}  // namespace plumb
