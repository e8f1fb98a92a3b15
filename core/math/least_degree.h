// SPDX-License-Identifier: MIT
/// An order of elimination that keeps fill small: the row that has entries with the fewest others
/// comes next (approximate minimum degree, Amestoy, Davis and Duff 1996).
///
/// What is eliminated becomes an element: a set of rows, all of which have entries with each other
/// from then on. A row is known by the elements that it is in and by the neighbours that it has
/// besides; its degree is bounded by the sum of what these have outside of the last element. Rows
/// that are alike are one from then on, and an element within another is absorbed by it.
#pragma once

#include "math/row_graph.h"

#include <cstdint>
#include <span>
#include <vector>

namespace plumb {

/// Reusable memory for one order after another.
class LeastDegree {
public:
    /// [place] row.
    void find(const RowGraph& graph, std::vector<std::uint32_t>& order);

private:
    /// A row or, once it is eliminated, its element.
    struct Node {
        std::uint32_t first, length;   ///< in list_: elements that it is in, then rows; or its rows
        std::uint32_t elements;        ///< so many of the list
        std::uint32_t weight;          ///< rows that it stands for, 0 if another stands for it
        std::uint32_t degree;          ///< a bound; of an element, the weight of its rows
        std::uint32_t next, previous;  ///< of the same degree, or of the same hash
        std::uint32_t parent;          ///< by which it was absorbed
        std::uint32_t joined;          ///< the last element that it became one of
        std::uint32_t outside;         ///< of an element: weight of its rows outside of the pivot's
        std::uint32_t counted;         ///< the pivot for which that was counted
        std::uint32_t hash, mark;
    };

    void begin(const RowGraph& graph);
    std::uint32_t take_least();
    void make_element(std::uint32_t pivot);
    void count_outside(std::uint32_t pivot);
    void update_rows(std::uint32_t pivot);
    void update_row(std::uint32_t at, std::uint32_t pivot);
    void join_alike(std::uint32_t pivot);
    void join_those_like(std::uint32_t at);
    void put_back(std::uint32_t pivot);
    void list_order(std::vector<std::uint32_t>& order);

    void link(std::uint32_t at, std::uint32_t degree);
    void unlink(std::uint32_t at);
    void compact();
    std::span<std::uint32_t> list_of(const Node& node) {
        return {list_.data() + node.first, node.length};
    }
    /// Whether a row counts no more, or is in the element of the pivot anyway.
    static bool is_within(const Node& row, std::uint32_t pivot) {
        return row.weight == 0 || row.joined == pivot;
    }

    std::uint32_t rows_ = 0, eliminated_ = 0;
    std::uint32_t least_ = 0;  // no row has a smaller degree
    std::uint32_t marks_ = 0;
    std::size_t room_ = 0;     // of list_, beyond which it is made compact
    std::vector<Node> nodes_;  // [row], and one that absorbs what has entries with most others
    std::vector<std::uint32_t> list_, compact_;
    std::vector<std::uint32_t> head_;    // [degree], then [node]: its first child
    std::vector<std::uint32_t> bucket_;  // [hash]
    std::vector<std::uint32_t> open_;
};

}  // namespace plumb
