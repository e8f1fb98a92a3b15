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
    /// the pairs of parts whose fat bounds overlap, in any order; it is asked only where many parts
    /// left theirs. Few are compared with all others here.
    template <class Search>
    void find(std::vector<PartPair>& near, BodyTable& table, Search&& search) {
        const bool any = find_escaped(table);
        if (order_ != table.order() || escaped_.size() > table.parts().size() / 16) {
            fatten_all(table);
            wide_.clear();
            search(wide_);
            sort_pairs(wide_, table.parts());
        } else if (any) {
            renew_escaped(table);
        }
        take_overlapping(near);
    }

    /// Leaves out the pairs that the caller has contacts for. `pairs` stand sorted.
    void apply(const PairFilter& filter, std::vector<PartPair>& pairs);

private:
    /// A part's bounds when its fat ones were made.
    struct Made {
        Vec3 low;                 ///< their lower corner [m]
        std::uint64_t detection;  ///< which
    };

    bool find_escaped(BodyTable& table);
    void fatten_all(BodyTable& table);
    void fatten(Part& part, Made& made) const;
    void line_up_escaped(BodyTable& table);
    void renew_escaped(BodyTable& table);
    void merge_renewed();
    void take_overlapping(std::vector<PartPair>& near) const;

    /// In one line of the processor's cache.
    struct alignas(64) Bounds {
        Aabb box;
    };
    /// A part that left its fat bounds, with its new ones.
    struct alignas(64) Escaped {
        Aabb fat;
        double reach;  ///< the greatest x of it and of all before it [m]
        std::uint32_t part;
    };

    std::vector<PartPair> wide_, renewed_;
    // What walks over all pairs and parts read of them, side by side in memory.
    std::vector<Bounds> bounds_;               ///< [part] nothing where it is absent
    std::vector<Bounds> fats_;                 ///< [part]
    std::vector<std::uint32_t> bodies_;        ///< [part]
    std::vector<std::uint32_t> escaped_;       ///< parts that came, or left their fat bounds
    std::vector<std::uint8_t> is_outdated_;    ///< [part, of now or before] its pairs may be others
    std::vector<Escaped> line_;                ///< the same parts along x, by where they begin
    std::vector<Made> made_;                   ///< [part]
    std::uint64_t order_ = ~std::uint64_t{0};  ///< of the table, BodyTable::order
    std::uint64_t detection_ = 0;              ///< counted
    std::vector<CandidatePair> asked_;         ///< of the filter, each once
    std::vector<std::size_t> first_;           ///< [asked, and the end] of their pairs of parts
    std::vector<std::uint8_t> wanted_;         ///< [asked]
};

}  // namespace plumb
