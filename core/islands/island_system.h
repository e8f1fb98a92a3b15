// SPDX-License-Identifier: MIT
/// Newton's matrix of an island: symmetric, of 6 × 6 blocks, a block row a body.
///
/// That of few bodies is factored block by block (math/block_cholesky.h), that of many by dense
/// fronts (math/sparse_ldlt.h), which are several times as quick on them.
#pragma once

#include "math/block_cholesky.h"
#include "math/sparse_ldlt.h"

#include <memory>

namespace plumb {

class IslandSystem {
public:
    using Pattern = BlockCholesky::Pattern;

    /// The memory of systems of many bodies, which they pass on to each other: there are few of
    /// them, and great ones.
    using Spare = std::unique_ptr<SparseLdlt>;

    /// Chooses the order of elimination; `many`: of more than a few hundred bodies. Returns whether
    /// `factor` takes no more than about `most` products; if not, there are no rows.
    bool analyse(std::uint32_t rows, const Pattern& pattern, bool many, std::uint64_t most,
                 Spare& spare);

    std::uint32_t rows() const { return fronts_ ? fronts_->rows() / 2 : blocks_.rows(); }

    /// What `factor` takes, in products of two 6 × 6 blocks.
    std::uint64_t block_products() const;

    // as those of BlockCholesky

    void clear() { fronts_ ? fronts_->clear() : blocks_.clear(); }
    void add(std::uint32_t i, const Matrix6d& block) {
        fronts_ ? add_to_fronts(i, block) : blocks_.add(i, block);
    }
    void add(std::uint32_t i, std::uint32_t j, const Matrix6d& block) {
        fronts_ ? add_to_fronts(i, j, block) : blocks_.add(i, j, block);
    }
    void add_product(std::uint32_t i, const Vector6d& x, std::uint32_t j, const Vector6d& y);

    /// Returns whether there are factors: of fronts they may be of a matrix that is not definite.
    bool factor() { return fronts_ ? fronts_->factor() : blocks_.factor(); }
    void solve(std::vector<Vector6d>& x);

private:
    bool analyse_many(std::uint32_t rows, const Pattern& pattern, std::uint64_t most);
    void add_to_fronts(std::uint32_t i, const Matrix6d& block);
    void add_to_fronts(std::uint32_t i, std::uint32_t j, const Matrix6d& block);

    BlockCholesky blocks_;
    std::unique_ptr<SparseLdlt> fronts_;   // of many rows: two of 3 × 3 blocks a body
    std::vector<Vector3d> halves_;         // memory of solve
    std::vector<SparseLdlt::Pair> pairs_;  // memory of analyse_many
};

}  // namespace plumb
