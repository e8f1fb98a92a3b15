// SPDX-License-Identifier: MIT
/// Which rows of a symmetric matrix have entries with each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace plumb {

/// Reusable memory for one graph after another.
class RowGraph {
public:
    using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

    /// Memory for so many rows and pairs.
    void reserve(std::size_t rows, std::size_t pairs);

    /// Of pairs of rows below `rows`; a pair may come more than once, in either order, and what is
    /// a pair with itself is none.
    void build(std::uint32_t rows, const Pairs& pairs);

    std::uint32_t rows() const { return static_cast<std::uint32_t>(first_.size()) - 1; }

    /// [row] in `list`, and one more: where its neighbours begin.
    const std::vector<std::uint32_t>& first() const { return first_; }
    /// Neighbours of one row after another, rising.
    const std::vector<std::uint32_t>& list() const { return list_; }
    std::span<const std::uint32_t> near(std::uint32_t row) const {
        return {list_.data() + first_[row], list_.data() + first_[row + 1]};
    }

private:
    std::vector<std::uint32_t> first_{0}, list_;
    std::vector<std::uint32_t> bucket_, end_;  // memory of build
};

}  // namespace plumb
