// SPDX-License-Identifier: MIT
/// The couplings of joints (step/coupling_row.h) of islands that are solved exactly.
#pragma once

#include "step/coupling_row.h"
#include "step/island_rows.h"
#include "step/substep_time.h"

#include <span>
#include <vector>

namespace plumb {

class IslandCouplings {
public:
    void clear() { couplings_.clear(); }

    /// Adds a coupling of one of the islands.
    void add(const World& world, const ContactIslands& islands, std::uint32_t coupling);

    std::uint32_t size() const { return static_cast<std::uint32_t>(couplings_.size()); }
    /// Index in the world's table.
    std::uint32_t coupling(std::uint32_t i) const { return couplings_[i].coupling; }

    /// Once a substep: adds its row at the start, with the impulse of the one before.
    void begin(const World& world, const SubstepTime& time, std::uint32_t i,
               std::vector<IslandRow>& rows);

    /// How far the coupling is from what its row asks for at the end of the substep [m], [rad]. It
    /// is linear, and asks for the same all along.
    double ask(std::uint32_t i, std::span<const Vector6d> velocity, double h,
               std::vector<IslandRow>& rows) const;

    /// The impulse of the substep, into the world's table.
    void store_impulses(std::uint32_t i, const std::vector<IslandRow>& rows,
                        std::vector<JointCoupling>& couplings) const;

private:
    struct Member {
        std::uint32_t coupling;                 ///< in the world's table
        std::array<std::uint32_t, 4> body, at;  ///< of both joints: of the world, of the island
        std::uint32_t row = 0;
        double deferred = 0;
    };
    std::vector<Member> couplings_;
};

}  // namespace plumb
