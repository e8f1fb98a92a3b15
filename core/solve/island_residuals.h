// SPDX-License-Identifier: MIT
/// Gathers the residuals of constraints (effects/residual.h) by the islands of their bodies.
#pragma once

#include "effects/residual.h"
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

/// Reusable memory. Bodies are named by their rows in the velocity table; those that are not of
/// dynamic bodies join nothing. Sums are in the order of the calls.
class IslandResiduals {
public:
    /// Forgets what there was.
    void begin() { islands_.clear(); }

    /// Takes a partition that others have found, of which some bodies may be no part.
    void take(const World& world, const ContactIslands& found);

    // or makes one

    /// Joins what joints and links hold together.
    void join_ties(const World& world);
    void join(std::int32_t row_a, std::int32_t row_b) {
        const auto count = static_cast<std::int32_t>(parent_.size());
        if (row_a >= count || row_b >= count) return;
        const std::int32_t a = root(row_a), b = root(row_b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    void end_joining(const World& world);

    // then

    /// Constraints between two bodies. Nothing is kept of bodies that are in no island.
    void add(std::int32_t row_a, std::int32_t row_b, const ResidualSum& lacking) {
        const auto count = static_cast<std::int32_t>(island_.size());
        const std::int32_t row = row_a < count ? row_a : row_b;
        if (row < count && island_[row] != kNoIsland) sums_[island_[row]].add(lacking);
    }

    /// What came of the last substep, of length h [s].
    StepResidual find(double h);

    /// Of that, each island that has constraints, in the order of their bodies' least rows.
    const std::vector<IslandResidual>& islands() const { return islands_; }

private:
    static constexpr std::uint32_t kNoIsland = ~0u;

    void weigh(const World& world, std::size_t count);

    /// The least row of an island is its root.
    std::int32_t root(std::int32_t row) {
        while (parent_[row] != row) row = parent_[row] = parent_[parent_[row]];
        return row;
    }

    std::vector<std::int32_t> parent_;   // [dynamic row] while islands are joined
    std::vector<std::uint32_t> island_;  // [dynamic row] ~0u where there is none
    std::vector<ResidualSum> sums_;      // [island]
    std::vector<IslandResidual> islands_;
};

}  // namespace plumb
