// SPDX-License-Identifier: MIT
/// Which ties can be solved in one system with deformables: of bodies all that hang together, or
/// none of them; and links with particles.
#pragma once

#include "math/disjoint_sets.h"
#include "ties/tie_list.h"
#include "world/world.h"

#include <vector>

namespace plumb {

class ElasticTieChoice {
public:
    /// Once a step; those of the world, of bodies if it `takes_bodies`.
    const std::vector<Tie>& find(const World& world, bool takes_bodies);

private:
    void find_of_bodies(const World& world);
    void find_groups(const World& world);

    TieList list_;
    DisjointSets groups_;                 ///< of the world's bodies that move, by ties
    std::vector<double> weight_;          ///< [lowest of a group] in a substep [N s]
    std::vector<std::uint8_t> lies_;      ///< [world's body] whether it touches particles
    std::vector<std::uint8_t> is_other_;  ///< [lowest of a group] whether others solve it
    std::vector<Tie> found_;
};

}  // namespace plumb
