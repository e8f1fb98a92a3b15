// SPDX-License-Identifier: MIT
/// Pairs that may touch, kept from one detection to the next.
///
/// The broad phase works on bounds a little larger than the parts' own. As long as every part stays
/// inside its fat bounds, what it found holds all pairs whose own bounds overlap, and a walk over
/// it replaces the search. What comes out is exactly the pairs whose own bounds overlap now:
/// nothing of the past shows in it.
#pragma once

#include "manifold/body_table.h"

#include <plumb/proximity.h>

namespace plumb {

class Candidates {
public:
    /// Puts into `near` all pairs that overlap and are wanted, sorted. `search` fills a list with
    /// the pairs of parts whose fat bounds overlap, in any order.
    template <class Search>
    void find(std::vector<PartPair>& near, BodyTable& table, Search&& search) {
        if (!hold(table)) {
            fatten(table);
            wide_.clear();
            search(wide_);
            sort_pairs(wide_, table.parts());
        }
        take_overlapping(near, table);
    }

    /// Leaves out the pairs that the caller has contacts for. `pairs` stand sorted.
    void apply(const PairFilter& filter, std::vector<PartPair>& pairs, const BodyTable& table);

private:
    /// Whether every part is inside its fat bounds, and the parts are still the same.
    bool hold(const BodyTable& table);
    void fatten(BodyTable& table);
    void take_overlapping(std::vector<PartPair>& near, const BodyTable& table) const;

    std::vector<PartPair> wide_;
    std::vector<Vec3> low_before_;  ///< [part] corner of its bounds at the last search [m]
    std::uint64_t version_ = ~std::uint64_t{0};
    std::uint32_t since_search_ = 0;  ///< detections
    std::vector<CandidatePair> asked_;     ///< by the filter, each once
    std::vector<std::uint8_t> wanted_;
};

}  // namespace plumb
