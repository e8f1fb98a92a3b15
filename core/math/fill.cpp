// SPDX-License-Identifier: MIT
#include "math/fill.h"

#include "math/growing.h"

#include <algorithm>
#include <utility>

namespace plumb {
namespace {

constexpr std::uint32_t kNoColumn = ~0u;

}  // namespace

void Fill::put_children_first(std::vector<std::uint32_t>& order, const RowGraph& graph,
                              const std::vector<std::uint32_t>& place) {
    const auto n = static_cast<std::uint32_t>(order.size());
    find_parents(order, graph, place);
    list_children();
    // from behind: a parent, then its children from the last on
    size_anew(order_, n);
    std::uint32_t at = n;
    for (std::uint32_t root = n; root-- > 0;) {
        if (parent_[root] != kNoColumn) continue;
        open_.push_back(root);
        while (!open_.empty()) {
            const std::uint32_t p = open_.back();
            open_.pop_back();
            order_[--at] = order[p];
            for (std::uint32_t c = child_[p]; c != kNoColumn; c = sibling_[c]) open_.push_back(c);
        }
    }
    std::swap(order, order_);
}

/// The first row below a column's diagonal is its parent: it is the last of all columns before the
/// row from which it is reached (Liu 1990). Ancestors are short cuts.
void Fill::find_parents(const std::vector<std::uint32_t>& order, const RowGraph& graph,
                        const std::vector<std::uint32_t>& place) {
    const auto n = static_cast<std::uint32_t>(order.size());
    fill_anew(parent_, n, kNoColumn);
    fill_anew(ancestor_, n, kNoColumn);
    for (std::uint32_t p = 0; p < n; ++p)
        for (const std::uint32_t row : graph.near(order[p])) {
            std::uint32_t q = place[row];
            if (q > p) continue;
            while (ancestor_[q] != kNoColumn && ancestor_[q] != p)
                q = std::exchange(ancestor_[q], p);
            if (ancestor_[q] == kNoColumn) ancestor_[q] = parent_[q] = p;
        }
}

/// Rising.
void Fill::list_children() {
    const std::size_t n = parent_.size();
    fill_anew(child_, n, kNoColumn);
    size_anew(sibling_, n);
    for (auto p = static_cast<std::uint32_t>(n); p-- > 0;)
        if (parent_[p] != kNoColumn) sibling_[p] = std::exchange(child_[parent_[p]], p);
}

/// A column has its own rows and those of its children. Where these are no more than those of one
/// child, as within a front, the list is the same one.
bool Fill::find(const std::vector<std::uint32_t>& own_first, const std::vector<std::uint32_t>& own,
                double most) {
    const auto n = static_cast<std::uint32_t>(own_first.size() - 1);
    double work = 0;
    rows_.clear();
    size_anew(below_, n), size_anew(sibling_, n);
    fill_anew(child_, n, kNoColumn);
    fill_anew(seen_, n, kNoColumn);
    for (std::uint32_t p = 0; p < n; ++p) {
        Range range{0, 0};
        for (std::uint32_t c = child_[p]; c != kNoColumn; c = sibling_[c])
            if (below_[c].last - below_[c].first > range.last - range.first) range = below_[c];
        if (range.first < range.last) ++range.first;  // p itself
        seen_[p] = p;
        for (std::size_t k = range.first; k < range.last; ++k) seen_[rows_[k]] = p;
        more_.clear();
        const auto take = [&](std::span<const std::uint32_t> rows) {
            for (const std::uint32_t row : rows)
                if (seen_[row] != p) seen_[row] = p, more_.push_back(row);
        };
        take({own.data() + own_first[p], own.data() + own_first[p + 1]});
        for (std::uint32_t c = child_[p]; c != kNoColumn; c = sibling_[c]) take(below(c));
        if (!more_.empty()) range = widened(range);
        below_[p] = range;
        const auto size = static_cast<double>(range.last - range.first);
        work += 0.5 * size * (size + 1);
        if (work > most) return false;
        if (size > 0) sibling_[p] = std::exchange(child_[rows_[range.first]], p);
    }
    return true;
}

/// By the rows of more_.
Fill::Range Fill::widened(Range range) {
    std::sort(more_.begin(), more_.end());
    const std::size_t first = rows_.size();
    rows_.resize(first + (range.last - range.first) + more_.size());
    const auto from = rows_.begin();
    std::merge(from + static_cast<std::ptrdiff_t>(range.first),
               from + static_cast<std::ptrdiff_t>(range.last), more_.begin(), more_.end(),
               from + static_cast<std::ptrdiff_t>(first));
    return {first, rows_.size()};
}

}  // namespace plumb
