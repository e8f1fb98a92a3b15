// SPDX-License-Identifier: MIT
#include "math/sparse_ldlt.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <numeric>

namespace plumb {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// Fronts of at most so many block columns are merged where up to the first share of the result is
/// filled with zeros; greater ones up to the second.
constexpr std::uint32_t kSmallFront = 6;
constexpr double kSmallFill = 0.4, kFill = 0.1;

using Lists = std::vector<std::vector<std::uint32_t>>;

/// Least degree first (Amestoy, Davis and Duff 1996): [place] row.
std::vector<std::uint32_t> least_degree(std::uint32_t rows,
                                        const std::vector<SparseLdlt::Pair>& pattern) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(2 * pattern.size() + rows);
    for (std::uint32_t i = 0; i < rows; ++i)
        entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1.0);
    for (const auto& [i, j] : pattern) {
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j), 1.0);
        entries.emplace_back(static_cast<int>(j), static_cast<int>(i), 1.0);
    }
    Eigen::SparseMatrix<double> matrix(static_cast<int>(rows), static_cast<int>(rows));
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> found;
    Eigen::AMDOrdering<int>()(matrix, found);
    std::vector<std::uint32_t> order(rows);
    for (std::uint32_t p = 0; p < rows; ++p)
        order[p] = static_cast<std::uint32_t>(found.indices()[static_cast<int>(p)]);
    return order;
}

/// Rows of each column of L, rising, in the order `place`; or none, if that is more than `most`
/// multiplications to factor.
std::optional<Lists> fill_in(const std::vector<std::uint32_t>& place,
                             const std::vector<SparseLdlt::Pair>& pattern, double most) {
    constexpr double kOfProduct = 27;  // of two 3 × 3 blocks
    double work = 0;
    const std::size_t n = place.size();
    Lists structure(n), children(n);
    for (const auto& [i, j] : pattern)
        if (i != j) structure[std::min(place[i], place[j])].push_back(std::max(place[i], place[j]));
    std::vector<std::uint32_t> seen(n, kNone), all;
    for (std::uint32_t p = 0; p < n; ++p) {
        all.clear();
        seen[p] = p;
        const auto take = [&](const std::vector<std::uint32_t>& rows) {
            for (const std::uint32_t row : rows)
                if (seen[row] != p) seen[row] = p, all.push_back(row);
        };
        take(structure[p]);
        for (const std::uint32_t child : children[p]) take(structure[child]);
        std::sort(all.begin(), all.end());
        structure[p] = all;
        const auto below = static_cast<double>(all.size());
        work += kOfProduct * 0.5 * below * (below + 1);
        if (work > most) return std::nullopt;
        if (!all.empty()) children[all[0]].push_back(p);
    }
    return structure;
}

/// [new place] old place: children right before their parents.
std::vector<std::uint32_t> children_first(const Lists& structure) {
    const auto n = static_cast<std::uint32_t>(structure.size());
    Lists children(n);
    std::vector<std::uint32_t> roots, order, open;
    for (std::uint32_t p = 0; p < n; ++p)
        (structure[p].empty() ? roots : children[structure[p][0]]).push_back(p);
    // from behind: a parent, then its children, all turned round in the end
    for (std::size_t r = roots.size(); r-- > 0;) {
        open.push_back(roots[r]);
        while (!open.empty()) {
            const std::uint32_t p = open.back();
            open.pop_back();
            order.push_back(p);
            open.insert(open.end(), children[p].begin(), children[p].end());
        }
    }
    std::reverse(order.begin(), order.end());
    return order;
}

}  // namespace

SparseLdlt::SparseLdlt() : SparseLdlt(front_kernels_of<2>()) {}
SparseLdlt::SparseLdlt(const FrontKernels& kernels) : kernels_(kernels) {}

// ---- once a pattern

bool SparseLdlt::order(std::uint32_t rows, const std::vector<Pair>& pattern, double most) {
    rows_ = rows;
    order_ = least_degree(rows, pattern);
    place_.resize(rows);
    const auto invert = [&] {
        for (std::uint32_t p = 0; p < rows; ++p) place_[order_[p]] = p;
    };
    invert();
    const std::optional<Lists> found = fill_in(place_, pattern, most);
    if (!found) {
        rows_ = 0;
        return false;
    }
    const std::vector<std::uint32_t> later = children_first(*found);
    std::vector<std::uint32_t> order(rows);
    for (std::uint32_t p = 0; p < rows; ++p) order[p] = order_[later[p]];
    order_ = std::move(order);
    invert();
    find_columns(pattern);
    find_fronts(*fill_in(place_, pattern, kAnyWork));
    diagonal_.resize(rows);
    below_.resize(below_row_.size());
    attach(0, {});
    return true;
}

void SparseLdlt::find_columns(const std::vector<Pair>& pattern) {
    Lists below(rows_);
    for (const auto& [i, j] : pattern)
        if (i != j) below[std::min(place_[i], place_[j])].push_back(std::max(place_[i], place_[j]));
    column_first_.assign(1, 0);
    below_row_.clear();
    for (auto& list : below) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        below_row_.insert(below_row_.end(), list.begin(), list.end());
        column_first_.push_back(static_cast<std::uint32_t>(below_row_.size()));
    }
}

/// Columns that have the same rows below them make a front; small ones are merged into their
/// parents, which fills little and saves much.
void SparseLdlt::find_fronts(const Lists& structure) {
    struct Draft {
        std::uint32_t first, last;
        const std::vector<std::uint32_t>* rows;  // below its last column
        double filled;                           // blocks that are not 0
    };
    const auto blocks = [](double width, double rows) {
        return width * (width + 1) / 2 + width * rows;
    };
    std::vector<Draft> drafts;
    const auto can_merge = [&](const Draft& child, const Draft& parent) {
        if (child.last != parent.first || child.rows->empty() || child.rows->front() >= parent.last)
            return false;
        const double filled = child.filled + parent.filled;
        const double whole =
            blocks(parent.last - child.first, static_cast<double>(parent.rows->size()));
        const bool small = parent.last - child.first <= kSmallFront;
        return whole - filled <= (small ? kSmallFill : kFill) * whole;
    };
    for (std::uint32_t p = 0; p < rows_; ++p) {
        drafts.push_back(
            {p, p + 1, &structure[p], blocks(1, static_cast<double>(structure[p].size()))});
        while (drafts.size() > 1 && can_merge(drafts[drafts.size() - 2], drafts.back())) {
            const Draft child = drafts[drafts.size() - 2];
            drafts.erase(drafts.end() - 2);
            drafts.back().first = child.first, drafts.back().filled += child.filled;
        }
    }
    fronts_.clear(), row_.clear();
    std::vector<std::uint32_t> front_of(rows_);
    for (const Draft& d : drafts) {
        Front front{};
        front.first = d.first, front.last = d.last;
        front.row = static_cast<std::uint32_t>(row_.size());
        row_.insert(row_.end(), d.rows->begin(), d.rows->end());
        front.row_end = static_cast<std::uint32_t>(row_.size());
        for (std::uint32_t p = d.first; p < d.last; ++p)
            front_of[p] = static_cast<std::uint32_t>(fronts_.size());
        fronts_.push_back(front);
    }
    fronts_.push_back({rows_, rows_, 0, 0, 0, 0, kNone, 0, 0});
    children_.assign(fronts_.size(), {});
    for (std::uint32_t i = 0; i < root(); ++i) {
        Front& f = fronts_[i];
        f.parent = f.row == f.row_end ? root() : front_of[row_[f.row]];
        children_[f.parent].push_back(i);
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
    between_.resize(pairs.size());
    more_block_.resize(std::size_t(9) * more * more);
    find_attached_rows();
    place_numbers();
}

/// A front has the attached rows of its columns and of its children.
void SparseLdlt::find_attached_rows() {
    more_row_.clear();
    std::vector<std::uint32_t>& seen = position_;
    seen.assign(more_, kNone);
    std::size_t pair = 0;
    for (std::uint32_t i = 0; i < root(); ++i) {
        Front& f = fronts_[i];
        f.more = static_cast<std::uint32_t>(more_row_.size());
        const auto take = [&](std::uint32_t row) {
            if (seen[row] != i) seen[row] = i, more_row_.push_back(row);
        };
        for (; pair < pairs_.size() && pairs_[pair].place < f.last; ++pair) take(pairs_[pair].more);
        for (const std::uint32_t child : children_[i])
            for (std::uint32_t k = fronts_[child].more; k < fronts_[child].more_end; ++k)
                take(more_row_[k]);
        f.more_end = static_cast<std::uint32_t>(more_row_.size());
        std::sort(more_row_.begin() + f.more, more_row_.end());
    }
}

/// Where each front's factors lie, and how much memory is needed.
void SparseLdlt::place_numbers() {
    work_ = 0;
    left_.resize(fronts_.size());
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
        if (!children_[i].empty()) top = left_[children_[i][0]];
        left_[i] = top;
        top += static_cast<std::size_t>(left * left);
        highest = std::max(highest, top);
    }
    factors_.resize(factors);
    stack_.resize(highest);
    front_.resize(widest * widest);
    memory_.resize(widest * front::kPanel);
    position_.resize(std::max<std::size_t>(rows_, widest));
    x_.resize(std::size_t(3) * (rows_ + more_));
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
        for (const std::uint32_t child : children_[i]) add_child(fronts_[child], left_[child], i);
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
