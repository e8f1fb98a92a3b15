// SPDX-License-Identifier: MIT
/// Sparse symmetric systems of 3 × 3 blocks, A = L D Lᵀ, by elimination of dense fronts (Duff and
/// Reid 1983).
///
/// Two kinds of block rows: `order` takes those whose pattern stays (the particles), and chooses
/// the order in which they are eliminated; `attach` takes those that have blocks with many of them
/// (the pressures of balloons) or come and go, which are eliminated last. Then any number of times:
/// `clear`, add to blocks, `factor`, `solve`. Definite or quasi-definite systems need no pivoting.
#pragma once

#include "math/dense_front.h"
#include "math/fill.h"
#include "math/least_degree.h"
#include "math/row_graph.h"
#include "math/types.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace plumb {

class SparseLdlt {
public:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    static constexpr double kAnyWork = std::numeric_limits<double>::infinity();

    /// A block below the diagonal, and whether A(i, j) of the asking pair is its transpose.
    struct Slot {
        std::uint32_t index = 0;
        bool transposed = false;
    };

    SparseLdlt();
    /// The quickest that the processor runs (kernels/front_kernels.h).
    explicit SparseLdlt(const FrontKernels& kernels);

    /// `rows` block rows, and the pairs of them that have blocks; a pair may come more than once,
    /// in either order. Returns whether `factor` takes no more than `most` multiplications, about;
    /// if not, there are no rows, and the time and memory for them were not spent. Takes memory
    /// only where there is more to order than ever before.
    bool order(std::uint32_t rows, const std::vector<Pair>& pattern, double most = kAnyWork);

    /// `more` block rows, numbered from `rows` on, and which of the others each has blocks with,
    /// (row below `rows`, row from it on), each once. Pairs among themselves need not be told.
    void attach(std::uint32_t more, const std::vector<Pair>& pairs);

    /// Memory for so many attached rows among each other.
    void reserve_attached(std::size_t most) { more_block_.reserve(9 * most * most); }

    std::uint32_t rows() const { return rows_; }
    std::uint32_t more() const { return more_; }
    /// Multiplications that `factor` takes, about.
    double work() const { return work_; }

    /// The block of a pair below `rows`, of which neither is the other, or none.
    std::optional<Slot> find_slot(std::uint32_t i, std::uint32_t j) const;
    /// The same of a pair that was told.
    Slot slot(std::uint32_t i, std::uint32_t j) const { return *find_slot(i, j); }
    /// Its block on the diagonal so far, of a row below `rows`.
    const Matrix3d& diagonal(std::uint32_t row) const { return diagonal_[place_[row]]; }

    void clear();
    void add(std::uint32_t row, const Matrix3d& block) {
        if (row < rows_)
            diagonal_[place_[row]] += block;
        else
            add_more(row, row, block);
    }
    /// Adds to A(i, j), as the slot of that pair was found.
    void add(Slot slot, const Matrix3d& block) {
        if (slot.transposed)
            below_[slot.index] += block.transpose();
        else
            below_[slot.index] += block;
    }
    /// Adds to A(row, more), of the pair told to `attach` at this index.
    void add_pair(std::size_t index, const Matrix3d& block) {
        between_[index] += block.transpose();
    }
    /// Adds to A(i, j) and, unless they are the same, its transpose to A(j, i); both from `rows`
    /// on.
    void add_more(std::uint32_t i, std::uint32_t j, const Matrix3d& block);

    /// Returns whether all pivots were finite and not 0.
    bool factor();

    /// x ← A⁻¹ x, with the factors of the last `factor`.
    void solve(std::vector<Vector3d>& x);

private:
    /// Columns that are eliminated together: places [first, last), and their rows below, first
    /// those of `row_`, then those of `more_row_`.
    struct Front {
        std::uint32_t first, last;
        std::uint32_t row, row_end;            ///< in row_
        std::uint32_t more, more_end;          ///< in more_row_
        std::uint32_t parent, child, sibling;  ///< its first child, the next of its parent
        std::uint32_t size;                    ///< numbers in a column
        std::size_t factors;                   ///< in factors_
    };
    struct AttachedPair {
        std::uint32_t place, more, told;  ///< of the row; attached row; index as told
    };
    /// Columns [first, last) that may become a front, with the rows below the last of them.
    struct Draft {
        std::uint32_t first, last;
        double filled;  ///< blocks that are not 0
    };

    void find_columns();
    void find_fronts();
    void find_drafts();
    void find_attached_rows();
    void place_numbers();
    std::size_t gather(const Front& front, std::size_t pair);
    void add_child(const Front& child, std::size_t left_at, std::uint32_t parent);
    template <class Visit>
    void each_row_below(const Front& front, Visit visit) const;

    std::uint32_t root() const { return static_cast<std::uint32_t>(fronts_.size()) - 1; }
    std::uint32_t width(std::uint32_t i) const {
        return i == root() ? 3 * more_ : 3 * (fronts_[i].last - fronts_[i].first);
    }

    FrontKernels kernels_;
    std::uint32_t rows_ = 0, more_ = 0;
    double work_ = 0;
    std::vector<std::uint32_t> order_, place_;             // [place] row; [row] place
    std::vector<std::uint32_t> column_first_, below_row_;  // [place] in below_; place of a block
    std::vector<Front> fronts_;  // children before parents; the last is that of attached rows
    std::vector<std::uint32_t> row_, more_row_;
    std::vector<AttachedPair> pairs_;  // by place

    std::vector<Matrix3d> diagonal_, below_;  // [place], [slot]
    std::vector<Matrix3d> between_;           // [told pair], rows of what is attached
    std::vector<double> more_block_;          // of attached rows, the lower triangle
    std::vector<double> factors_, stack_, front_, memory_, x_;
    std::vector<std::size_t> left_;        // [front] in stack_: what it leaves to its parent
    std::vector<std::uint32_t> position_;  // memory
    // memory of `order`
    RowGraph graph_;
    LeastDegree least_degree_;
    Fill fill_;
    std::vector<Draft> drafts_;
    std::vector<std::uint32_t> front_of_;  // [place]
};

}  // namespace plumb
