// SPDX-License-Identifier: MIT
/// The ties that hold now, with the bodies that each of them holds together: islands are made of
/// them.
#pragma once

#include "math/disjoint_sets.h"
#include "schedule/colouring.h"
#include "world/tie.h"

#include <utility>
#include <vector>

namespace plumb {

class TieList {
public:
    /// Once a step.
    void find(const World& world);

    /// First joints that make trees, then the seeds: joints that close loops or that hold nothing
    /// but by what drives them, links and couplings. An island needs nothing that touches where it
    /// has one of these.
    const std::vector<Tie>& all() const { return ties_; }
    const Tie& operator[](std::size_t i) const { return ties_[i]; }
    std::size_t first_seed() const { return first_seed_; }
    bool has_seeds() const { return first_seed_ < ties_.size(); }

    /// [tie] the rows of its bodies.
    const std::vector<BodyPair>& rows() const { return rows_; }

private:
    std::size_t move_loops_back(const World& world);
    bool closes_loop(const BodyPair& joint);

    std::vector<Tie> ties_;
    std::vector<BodyPair> rows_;
    std::size_t first_seed_ = 0;
    std::vector<std::pair<Tie, BodyPair>> loops_;
    DisjointSets joined_;      // of dynamic rows, then the ground; see closes_loop
    std::int32_t ground_ = 0;  // its row: whatever does not move
};

}  // namespace plumb
