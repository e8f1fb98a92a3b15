// SPDX-License-Identifier: MIT
#include "math/sparse_ldlt.h"

#include "math/growing.h"

#include <algorithm>
#include <utility>

namespace plumb {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// Fronts of at most so many block columns are merged where up to the first share of the result is
/// filled with zeros; greater ones up to the second.
constexpr std::uint32_t kSmallFront = 6;
constexpr double kSmallFill = 0.4, kFill = 0.1;

/// Multiplications of a product of two 3 × 3 blocks.
constexpr double kOfProduct = 27;

}  // namespace

SparseLdlt::SparseLdlt() : SparseLdlt(front_kernels_of<2>()) {}
SparseLdlt::SparseLdlt(const FrontKernels& kernels) : kernels_(kernels) {}

// ---- once a pattern

bool SparseLdlt::order(std::uint32_t rows, const std::vector<Pair>& pattern, double most) {
    rows_ = rows;
    graph_.build(rows, pattern);
    size_anew(place_, rows);
    const auto invert = [&] {
        for (std::uint32_t p = 0; p < rows; ++p) place_[order_[p]] = p;
    };
    least_degree_.find(graph_, order_), invert();
    fill_.put_children_first(order_, graph_, place_), invert();
    find_columns();
    if (!fill_.find(column_first_, below_row_, most / kOfProduct)) {
        rows_ = 0;
        return false;
    }
    find_fronts();
    size_anew(diagonal_, rows);
    size_anew(below_, below_row_.size());
    attach(0, {});
    return true;
}

/// A's own blocks below the diagonal.
void SparseLdlt::find_columns() {
    column_first_.clear(), below_row_.clear();
    for (std::uint32_t p = 0; p < rows_; ++p) {
        const auto first = static_cast<std::uint32_t>(below_row_.size());
        column_first_.push_back(first);
        for (const std::uint32_t row : graph_.near(order_[p]))
            if (place_[row] > p) below_row_.push_back(place_[row]);
        std::sort(below_row_.begin() + first, below_row_.end());
    }
    column_first_.push_back(static_cast<std::uint32_t>(below_row_.size()));
}

/// Columns that have the same rows below them make a front; small ones are merged into their
/// parents, which fills little and saves much.
void SparseLdlt::find_fronts() {
    find_drafts();
    fronts_.clear(), row_.clear();
    size_anew(front_of_, rows_);
    for (const Draft& d : drafts_) {
        Front front{};
        front.first = d.first, front.last = d.last;
        front.child = front.sibling = kNone;
        front.row = static_cast<std::uint32_t>(row_.size());
        const auto below = fill_.below(d.last - 1);
        row_.insert(row_.end(), below.begin(), below.end());
        front.row_end = static_cast<std::uint32_t>(row_.size());
        for (std::uint32_t p = d.first; p < d.last; ++p)
            front_of_[p] = static_cast<std::uint32_t>(fronts_.size());
        fronts_.push_back(front);
    }
    fronts_.push_back({rows_, rows_, 0, 0, 0, 0, kNone, kNone, kNone, 0, 0});
    for (std::uint32_t i = root(); i-- > 0;) {
        Front& f = fronts_[i];
        f.parent = f.row == f.row_end ? root() : front_of_[row_[f.row]];
        f.sibling = std::exchange(fronts_[f.parent].child, i);
    }
}

void SparseLdlt::find_drafts() {
    const auto blocks = [](double width, double rows) {
        return width * (width + 1) / 2 + width * rows;
    };
    const auto below = [&](const Draft& draft) { return fill_.below(draft.last - 1); };
    const auto can_merge = [&](const Draft& child, const Draft& parent) {
        if (child.last != parent.first || below(child).empty() ||
            below(child).front() >= parent.last)
            return false;
        const double filled = child.filled + parent.filled;
        const double whole =
            blocks(parent.last - child.first, static_cast<double>(below(parent).size()));
        const bool small = parent.last - child.first <= kSmallFront;
        return whole - filled <= (small ? kSmallFill : kFill) * whole;
    };
    drafts_.clear();
    for (std::uint32_t p = 0; p < rows_; ++p) {
        Draft draft{p, p + 1, blocks(1, static_cast<double>(fill_.below(p).size()))};
        for (; !drafts_.empty() && can_merge(drafts_.back(), draft); drafts_.pop_back())
            draft.first = drafts_.back().first, draft.filled += drafts_.back().filled;
        drafts_.push_back(draft);
    }
}

std::optional<SparseLdlt::Slot> SparseLdlt::find_slot(std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t p = place_[i], q = place_[j];
    const auto first = below_row_.begin() + column_first_[std::min(p, q)],
               last = below_row_.begin() + column_first_[std::min(p, q) + 1];
    const auto at = std::lower_bound(first, last, std::max(p, q));
    if (at == last || *at != std::max(p, q)) return std::nullopt;
    return Slot{static_cast<std::uint32_t>(at - below_row_.begin()), p < q};
}

// ---- whenever attached rows change

void SparseLdlt::attach(std::uint32_t more, const std::vector<Pair>& pairs) {
    more_ = more;
    pairs_.clear();
    pairs_.reserve(pairs.capacity()), between_.reserve(pairs.capacity());
    for (std::uint32_t k = 0; k < pairs.size(); ++k)
        pairs_.push_back({place_[pairs[k].first], pairs[k].second - rows_, k});
    std::sort(pairs_.begin(), pairs_.end(), [](const AttachedPair& a, const AttachedPair& b) {
        return a.place != b.place ? a.place < b.place : a.more < b.more;
    });
    size_anew(between_, pairs.size());
    size_anew(more_block_, std::size_t(9) * more * more);
    find_attached_rows();
    place_numbers();
}

/// A front has the attached rows of its columns and of its children.
void SparseLdlt::find_attached_rows() {
    more_row_.clear();
    std::vector<std::uint32_t>& seen = position_;
    fill_anew(seen, more_, kNone);
    std::size_t pair = 0;
    for (std::uint32_t i = 0; i < root(); ++i) {
        Front& f = fronts_[i];
        f.more = static_cast<std::uint32_t>(more_row_.size());
        const auto take = [&](std::uint32_t row) {
            if (seen[row] != i) seen[row] = i, more_row_.push_back(row);
        };
        for (; pair < pairs_.size() && pairs_[pair].place < f.last; ++pair) take(pairs_[pair].more);
        for (std::uint32_t c = f.child; c != kNone; c = fronts_[c].sibling)
            for (std::uint32_t k = fronts_[c].more; k < fronts_[c].more_end; ++k)
                take(more_row_[k]);
        f.more_end = static_cast<std::uint32_t>(more_row_.size());
        std::sort(more_row_.begin() + f.more, more_row_.end());
    }
}

/// Where each front's factors lie, and how much memory is needed.
void SparseLdlt::place_numbers() {
    work_ = 0;
    size_anew(left_, fronts_.size());
    std::size_t factors = 0, top = 0, highest = 0, widest = 1;
    for (std::uint32_t i = 0; i < fronts_.size(); ++i) {
        Front& f = fronts_[i];
        if (i == root())
            f.size = 3 * more_;
        else
            f.size = 3 * ((f.last - f.first) + (f.row_end - f.row) + (f.more_end - f.more));
        f.factors = factors;
        factors += std::size_t(width(i)) * f.size;
        widest = std::max<std::size_t>(widest, f.size);
        const double n = f.size, left = f.size - width(i);
        work_ += (n * n * n - left * left * left) / 6;
        if (f.child != kNone) top = left_[f.child];
        left_[i] = top;
        top += static_cast<std::size_t>(left * left);
        highest = std::max(highest, top);
    }
    size_anew(factors_, factors);
    size_anew(stack_, highest);
    size_anew(front_, widest * widest);
    size_anew(memory_, widest * front::kPanel);
    size_anew(position_, std::max<std::size_t>(rows_, widest));
    size_anew(x_, std::size_t(3) * (rows_ + more_));
}

// ---- numbers

void SparseLdlt::clear() {
    for (auto* blocks : {&diagonal_, &below_, &between_})
        for (Matrix3d& block : *blocks) block.setZero();
    std::fill(more_block_.begin(), more_block_.end(), 0.0);
}

void SparseLdlt::add_more(std::uint32_t i, std::uint32_t j, const Matrix3d& block) {
    const std::uint32_t row = std::max(i, j) - rows_, column = std::min(i, j) - rows_;
    double* to = more_block_.data() + std::size_t(3 * column) * 3 * more_ + 3 * row;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            to[std::size_t(c) * 3 * more_ + r] += i < j ? block(c, r) : block(r, c);
}

bool SparseLdlt::factor() {
    std::size_t pair = 0;
    for (std::uint32_t i = 0; i < fronts_.size(); ++i) {
        const Front& f = fronts_[i];
        // of each column what is on and below the diagonal
        const auto column = [&](std::uint32_t c) {
            return front_.begin() + std::size_t(c) * f.size + c;
        };
        for (std::uint32_t c = 0; c < f.size; ++c) std::fill_n(column(c), f.size - c, 0.0);
        if (i == root())
            std::copy(more_block_.begin(), more_block_.end(), front_.begin());
        else
            pair = gather(f, pair);
        for (std::uint32_t c = f.child; c != kNone; c = fronts_[c].sibling)
            add_child(fronts_[c], left_[c], i);
        if (!kernels_.factor(front_.data(), f.size, width(i), memory_.data())) return false;
        const std::uint32_t pivots = width(i), left = f.size - pivots;
        for (std::uint32_t c = 0; c < pivots; ++c)
            std::copy_n(column(c), f.size - c,
                        factors_.begin() + f.factors + std::size_t(c) * f.size + c);
        for (std::uint32_t c = 0; c < left; ++c)
            std::copy_n(column(pivots + c), left - c,
                        stack_.begin() + left_[i] + std::size_t(c) * left + c);
    }
    return true;
}

/// A's own blocks of a front's columns; returns the first pair of the next front.
std::size_t SparseLdlt::gather(const Front& f, std::size_t pair) {
    const std::uint32_t columns = f.last - f.first, rows = f.row_end - f.row;
    for (std::uint32_t k = 0; k < rows; ++k) position_[row_[f.row + k]] = columns + k;
    for (std::uint32_t p = f.first; p < f.last; ++p) {
        const std::uint32_t column = p - f.first;
        const auto put = [&](std::uint32_t row, const Matrix3d& block) {
            double* to = front_.data() + std::size_t(3 * column) * f.size + 3 * row;
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) to[std::size_t(c) * f.size + r] = block(r, c);
        };
        put(column, diagonal_[p]);
        for (std::uint32_t s = column_first_[p]; s < column_first_[p + 1]; ++s) {
            const std::uint32_t row = below_row_[s];
            put(row < f.last ? row - f.first : position_[row], below_[s]);
        }
        for (; pair < pairs_.size() && pairs_[pair].place == p; ++pair) {
            const auto at = std::lower_bound(more_row_.begin() + f.more,
                                             more_row_.begin() + f.more_end, pairs_[pair].more);
            const auto k = static_cast<std::uint32_t>(at - (more_row_.begin() + f.more));
            put(columns + rows + k, between_[pairs_[pair].told]);
        }
    }
    return pair;
}

/// What a child left to its parent's rows.
void SparseLdlt::add_child(const Front& child, std::size_t left_at, std::uint32_t parent) {
    const Front& f = fronts_[parent];
    std::uint32_t count = 0;
    const std::uint32_t columns = f.last - f.first, rows = f.row_end - f.row;
    std::uint32_t k = f.row;
    for (std::uint32_t r = child.row; r < child.row_end; ++r) {
        const std::uint32_t row = row_[r];
        if (row < f.last) {
            position_[count++] = row - f.first;
        } else {
            while (row_[k] < row) ++k;
            position_[count++] = columns + k - f.row;
        }
    }
    k = f.more;
    for (std::uint32_t r = child.more; r < child.more_end; ++r) {
        const std::uint32_t row = more_row_[r];
        if (parent == root()) {
            position_[count++] = row;
        } else {
            while (more_row_[k] < row) ++k;
            position_[count++] = columns + rows + k - f.more;
        }
    }
    const std::size_t left = std::size_t(3) * count;
    for (std::uint32_t c = 0; c < count; ++c)
        for (std::size_t within = 0; within < 3; ++within) {
            const double* from = stack_.data() + left_at + (3 * c + within) * left;
            double* to = front_.data() + (3 * position_[c] + within) * f.size;
            for (std::size_t r = within; r < 3; ++r) to[3 * position_[c] + r] += from[3 * c + r];
            for (std::uint32_t row = c + 1; row < count; ++row)
                for (std::size_t r = 0; r < 3; ++r) to[3 * position_[row] + r] += from[3 * row + r];
        }
}

/// Calls visit(k, place) for each block row below a front's columns, in its order; places of
/// attached rows follow the others.
template <class Visit>
void SparseLdlt::each_row_below(const Front& f, Visit visit) const {
    std::uint32_t k = 0;
    for (std::uint32_t r = f.row; r < f.row_end; ++r) visit(k++, row_[r]);
    for (std::uint32_t r = f.more; r < f.more_end; ++r) visit(k++, rows_ + more_row_[r]);
}

void SparseLdlt::solve(std::vector<Vector3d>& x) {
    const auto row_at = [&](std::uint32_t place) { return place < rows_ ? order_[place] : place; };
    for (std::uint32_t p = 0; p < rows_ + more_; ++p)
        for (int k = 0; k < 3; ++k) x_[3 * p + k] = x[row_at(p)][k];
    double* below = memory_.data();
    for (std::uint32_t i = 0; i < fronts_.size(); ++i) {
        const Front& f = fronts_[i];
        kernels_.solve_down(factors_.data() + f.factors, f.size, width(i), x_.data() + 3 * f.first,
                            below);
        each_row_below(f, [&](std::uint32_t k, std::uint32_t place) {
            for (int c = 0; c < 3; ++c) x_[3 * place + c] -= below[3 * k + c];
        });
    }
    for (std::uint32_t i = static_cast<std::uint32_t>(fronts_.size()); i-- > 0;) {
        const Front& f = fronts_[i];
        each_row_below(f, [&](std::uint32_t k, std::uint32_t place) {
            for (int c = 0; c < 3; ++c) below[3 * k + c] = x_[3 * place + c];
        });
        kernels_.solve_up(factors_.data() + f.factors, f.size, width(i), x_.data() + 3 * f.first,
                          below);
    }
    for (std::uint32_t p = 0; p < rows_ + more_; ++p)
        for (int k = 0; k < 3; ++k) x[row_at(p)][k] = x_[3 * p + k];
}

}  // namespace plumb
