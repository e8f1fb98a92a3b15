// SPDX-License-Identifier: MIT
#include "math/row_graph.h"

#include "math/growing.h"

#include <algorithm>

namespace plumb {

void RowGraph::reserve(std::size_t rows, std::size_t pairs) {
    first_.reserve(rows + 1), end_.reserve(rows + 1);
    list_.reserve(2 * pairs), bucket_.reserve(2 * pairs);
}

/// Sorted by two rounds of counting: into a bucket for each row, then from one bucket after another
/// to the lists of those who are in it, which so rise.
void RowGraph::build(std::uint32_t rows, const Pairs& pairs) {
    fill_anew(first_, rows + 1, 0u);
    for (const auto& [i, j] : pairs)
        if (i != j) ++first_[i + 1], ++first_[j + 1];
    for (std::uint32_t i = 0; i < rows; ++i) first_[i + 1] += first_[i];
    size_anew(bucket_, first_[rows]), size_anew(list_, first_[rows]);
    copy_anew(end_, first_);
    for (const auto& [i, j] : pairs)
        if (i != j) bucket_[end_[i]++] = j, bucket_[end_[j]++] = i;
    copy_anew(end_, first_);
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t k = first_[j]; k < first_[j + 1]; ++k) {
            const std::uint32_t i = bucket_[k];
            if (end_[i] == first_[i] || list_[end_[i] - 1] != j) list_[end_[i]++] = j;
        }
    // without the room of pairs that came more than once
    std::uint32_t size = 0;
    for (std::uint32_t i = 0; i < rows; ++i) {
        const std::uint32_t from = first_[i], count = end_[i] - from;
        std::copy_n(list_.begin() + from, count, list_.begin() + size);
        first_[i] = size;
        size += count;
    }
    first_[rows] = size;
    list_.resize(size);
}

}  // namespace plumb
