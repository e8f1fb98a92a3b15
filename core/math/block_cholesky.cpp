// SPDX-License-Identifier: MIT
#include "math/block_cholesky.h"

#include "math/growing.h"

#include <algorithm>
#include <iterator>
#include <span>

namespace plumb {
namespace {

constexpr std::uint32_t kDiagonal = 1u << 31;  // in an update's slot: a diagonal block

/// K = C Cᵀ in place, lower triangle. Returns whether all pivots were positive.
bool factor_block(Matrix6d& k) {
    for (int j = 0; j < 6; ++j) {
        double pivot = k(j, j);
        for (int p = 0; p < j; ++p) pivot -= k(j, p) * k(j, p);
        if (!(pivot > 0)) return false;
        const double root = std::sqrt(pivot), inverse = 1 / root;
        k(j, j) = root;
        for (int i = j + 1; i < 6; ++i) {
            double sum = k(i, j);
            for (int p = 0; p < j; ++p) sum -= k(i, p) * k(j, p);
            k(i, j) = sum * inverse;
        }
    }
    return true;
}

/// B ← B C⁻ᵀ, column by column.
void solve_from_right(const Matrix6d& c, Matrix6d& b) {
    for (int j = 0; j < 6; ++j) {
        for (int p = 0; p < j; ++p) b.col(j) -= c(j, p) * b.col(p);
        b.col(j) *= 1 / c(j, j);
    }
}

void solve_lower(const Matrix6d& c, Vector6d& x) {
    for (int i = 0; i < 6; ++i) {
        for (int p = 0; p < i; ++p) x[i] -= c(i, p) * x[p];
        x[i] /= c(i, i);
    }
}
void solve_upper(const Matrix6d& c, Vector6d& x) {
    for (int i = 5; i >= 0; --i) {
        for (int p = i + 1; p < 6; ++p) x[i] -= c(p, i) * x[p];
        x[i] /= c(i, i);
    }
}

/// Of a column with so many blocks below the diagonal: those of its pivot, its own and its updates.
std::uint64_t products_of(std::uint64_t blocks) { return 1 + blocks + blocks * (blocks + 1) / 2; }

}  // namespace

void BlockCholesky::reserve(std::uint32_t rows) {
    constexpr std::size_t kBlocks = 8;  // of a column
    graph_.reserve(rows, kBlocks * rows);
    list_.reserve(2 * kBlocks * rows), near_.reserve(rows), done_.reserve(rows);
    merged_.reserve(rows);
    order_.reserve(rows), place_.reserve(rows), columns_.reserve(rows);
    row_of_.reserve(kBlocks * rows), updates_.reserve(kBlocks * kBlocks * rows);
    diagonal_.reserve(rows), below_.reserve(kBlocks * rows), permuted_.reserve(rows);
}

bool BlockCholesky::analyse(std::uint32_t rows, const Pattern& pattern, std::uint64_t most) {
    size_anew(order_, rows), size_anew(place_, rows);
    if (!find_order(pattern, most)) {
        order_.clear();
        return false;
    }
    find_updates();
    size_anew(diagonal_, rows);
    size_anew(below_, row_of_.size());
    size_anew(permuted_, rows);
    return true;
}

/// Least degree first, of equals the first; what is eliminated makes its neighbours neighbours.
bool BlockCholesky::find_order(const Pattern& pattern, std::uint64_t most) {
    const auto n = static_cast<std::uint32_t>(order_.size());
    graph_.build(n, pattern);
    copy_anew(list_, graph_.list());
    size_anew(near_, n);
    for (std::uint32_t i = 0; i < n; ++i) near_[i] = {graph_.first()[i], graph_.first()[i + 1]};
    fill_anew(done_, n, std::uint8_t(0));
    products_ = 0;
    for (std::uint32_t p = 0; p < n; ++p) {
        std::uint32_t best = n;
        for (std::uint32_t i = 0; i < n; ++i)
            if (!done_[i] && (best == n || near_[i].size() < near_[best].size())) best = i;
        order_[p] = best, place_[best] = p;
        done_[best] = 1;
        for (std::size_t k = near_[best].first; k < near_[best].last; ++k)
            make_near(list_[k], best);
        products_ += products_of(near_[best].size());
        if (products_ > most) return false;
    }
    columns_.clear();
    row_of_.clear();
    for (std::uint32_t p = 0; p < n; ++p) {
        const auto first = static_cast<std::uint32_t>(row_of_.size());
        for (std::size_t k = near_[order_[p]].first; k < near_[order_[p]].last; ++k)
            row_of_.push_back(place_[list_[k]]);
        std::sort(row_of_.begin() + first, row_of_.end());
        columns_.push_back({first, static_cast<std::uint32_t>(row_of_.size())});
    }
    return true;
}

/// The neighbours of a row that is eliminated are those of its neighbour i, too.
void BlockCholesky::make_near(std::uint32_t i, std::uint32_t eliminated) {
    const auto list = [&](const Range& range) {
        return std::span(list_).subspan(range.first, range.size());
    };
    merged_.clear();
    std::ranges::set_union(list(near_[i]), list(near_[eliminated]), std::back_inserter(merged_));
    std::erase_if(merged_, [&](std::uint32_t k) { return k == i || k == eliminated; });
    Range& range = near_[i];
    if (merged_.size() > range.size())
        range.first = list_.size(), list_.resize(list_.size() + merged_.size());
    range.last = range.first + merged_.size();
    std::ranges::copy(merged_, list(range).begin());
}

void BlockCholesky::find_updates() {
    updates_.clear();
    for (const Column& c : columns_)
        for (std::uint32_t j = c.first; j < c.last; ++j) {
            updates_.push_back(row_of_[j] | kDiagonal);
            for (std::uint32_t i = j + 1; i < c.last; ++i)
                updates_.push_back(slot(row_of_[i], row_of_[j]));
        }
}

std::uint32_t BlockCholesky::slot(std::uint32_t row, std::uint32_t column) const {
    const Column& c = columns_[column];
    return static_cast<std::uint32_t>(
        std::lower_bound(row_of_.begin() + c.first, row_of_.begin() + c.last, row) -
        row_of_.begin());
}

void BlockCholesky::clear() {
    for (Matrix6d& m : diagonal_) m.setZero();
    for (Matrix6d& m : below_) m.setZero();
}

void BlockCholesky::add(std::uint32_t i, std::uint32_t j, const Matrix6d& block) {
    const std::uint32_t p = place_[i], q = place_[j];
    if (p > q)
        below_[slot(p, q)] += block;
    else
        below_[slot(q, p)] += block.transpose();
}

void BlockCholesky::add_product(std::uint32_t i, const Vector6d& x, std::uint32_t j,
                                const Vector6d& y) {
    const std::uint32_t p = place_[i], q = place_[j];
    if (p == q)
        diagonal_[p].noalias() += x * y.transpose();
    else if (p > q)
        below_[slot(p, q)].noalias() += x * y.transpose();
    else
        below_[slot(q, p)].noalias() += y * x.transpose();
}

bool BlockCholesky::factor() {
    const std::uint32_t* update = updates_.data();
    for (std::uint32_t p = 0; p < rows(); ++p) {
        Matrix6d& pivot = diagonal_[p];
        if (!factor_block(pivot)) return false;
        const Column c = columns_[p];
        for (std::uint32_t j = c.first; j < c.last; ++j) solve_from_right(pivot, below_[j]);
        for (std::uint32_t j = c.first; j < c.last; ++j) {
            diagonal_[*update++ & ~kDiagonal].noalias() -= below_[j] * below_[j].transpose();
            for (std::uint32_t i = j + 1; i < c.last; ++i)
                below_[*update++].noalias() -= below_[i] * below_[j].transpose();
        }
    }
    return true;
}

void BlockCholesky::solve(std::vector<Vector6d>& x) {
    const std::uint32_t n = rows();
    for (std::uint32_t p = 0; p < n; ++p) permuted_[p] = x[order_[p]];
    for (std::uint32_t p = 0; p < n; ++p) {
        solve_lower(diagonal_[p], permuted_[p]);
        for (std::uint32_t j = columns_[p].first; j < columns_[p].last; ++j)
            permuted_[row_of_[j]].noalias() -= below_[j] * permuted_[p];
    }
    for (std::uint32_t p = n; p-- > 0;) {
        for (std::uint32_t j = columns_[p].first; j < columns_[p].last; ++j)
            permuted_[p].noalias() -= below_[j].transpose() * permuted_[row_of_[j]];
        solve_upper(diagonal_[p], permuted_[p]);
    }
    for (std::uint32_t p = 0; p < n; ++p) x[order_[p]] = permuted_[p];
}

}  // namespace plumb
