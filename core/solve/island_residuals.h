// SPDX-License-Identifier: MIT
/// Gathers the residuals of constraints (effects/residual.h) by the islands of their bodies.
#pragma once

#include "effects/residual.h"
#include "kernels/pair_residual.h"
#include "schedule/contact_islands.h"
#include "world/world.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace plumb {

/// What constraints of one island lack together, in squares.
struct ResidualSum {
    double worst = 0, sum = 0;  ///< of their impulses, the greatest and all [N² s²]
    double error = 0;           ///< of their velocities, the greatest [m²/s²]
    double push = 0;            ///< what contacts bear along their normals [N s]
    std::uint32_t count = 0;    ///< of constraints
    bool swept = false;         ///< whether some were iterated

    void add(const ResidualSum& other) {
        worst = std::max(worst, other.worst);
        error = std::max(error, other.error);
        sum += other.sum;
        push += other.push;
        count += other.count;
        swept |= other.swept;
    }
};

/// What a kernel tells of `count` constraints that were swept.
template <class Real, int W>
ResidualSum swept_residual(const PairResidual<Real, W>& r, std::uint32_t lane,
                           std::uint32_t count) {
    return {double(r.worst[lane]),
            double(r.sum[lane]),
            double(r.error[lane]),
            double(r.push[lane]),
            count,
            true};
}

/// The bodies that joints and links hold together, as rows of the velocity table.
void add_tied_rows(const World& world, std::vector<BodyPair>& pairs);

/// Reusable memory. Bodies are named by their rows in the velocity table. Sums are in the order of
/// the calls.
class IslandResiduals {
public:
    /// Forgets what there was.
    void begin() { island_.clear(), islands_.clear(); }

    /// Takes a partition, of which some bodies may be no part.
    void take(const World& world, const ContactIslands& found);

    /// Constraints between two bodies. Nothing is kept of bodies that are in no island.
    void add(std::int32_t row_a, std::int32_t row_b, const ResidualSum& lacking) {
        const auto count = static_cast<std::int32_t>(island_.size());
        const std::int32_t row = row_a < count ? row_a : row_b;
        if (row < count && island_[row] != kNoIsland) sums_[island_[row]].add(lacking);
    }

    /// What came of the last substep, of length h [s].
    StepResidual find(double h);

    /// Of that, the island of a dynamic row; null where nothing is told of one.
    const IslandResidual* of(std::int32_t row) const {
        const auto i = static_cast<std::size_t>(row);
        const bool known = i < island_.size() && island_[i] != kNoIsland;
        return known && told_[island_[i]] != kNoIsland ? &islands_[told_[island_[i]]] : nullptr;
    }

    /// Of that, each island that has constraints, in the order of their bodies' least rows.
    const std::vector<IslandResidual>& islands() const { return islands_; }

private:
    static constexpr std::uint32_t kNoIsland = ~0u;

    void weigh(const World& world, std::size_t count);

    std::vector<std::uint32_t> island_;  // [dynamic row] ~0u where there is none
    std::vector<ResidualSum> sums_;      // [island]
    std::vector<std::uint32_t> told_;    // [island] its place in islands_, if it has constraints
    std::vector<IslandResidual> islands_;
};

}  // namespace plumb
