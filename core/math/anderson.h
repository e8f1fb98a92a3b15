// SPDX-License-Identifier: MIT
/// Anderson's acceleration (1965; Walker and Ni 2011) of an iteration z ← z + d(z).
///
/// From what earlier steps s changed of d it foresees what another step will change, and goes to
/// where d would be least in the mean of the squares:
///
///   s = d − Σ γᵢ (sᵢ + Δdᵢ),  with |d − Σ γᵢ Δdᵢ|² least
///
/// An iteration that goes on by a fixed share ends in about the root of its steps.
#pragma once

#include "math/types.h"

#include <Eigen/Cholesky>

#include <array>
#include <vector>

namespace plumb {

class Anderson {
public:
    using Rows = std::vector<Vector3d>;

    /// Memory for so many rows.
    void reserve(std::size_t rows) {
        for (Known& k : known_) k.step.reserve(rows), k.change.reserve(rows);
    }
    /// Forgets all steps; those to come have so many rows.
    void clear(std::size_t rows) {
        count_ = next_ = 0;
        for (Known& k : known_) k.step.resize(rows), k.change.resize(rows);
    }
    bool empty() const { return count_ == 0; }

    /// A step after which d was `after` in place of `before`. `dot(x, y)`: the scalar product by
    /// which d is to be small.
    template <class Dot>
    void add(const Rows& step, const Rows& before, const Rows& after, Dot dot) {
        Known& k = known_[next_];
        k.step = step;
        for (std::size_t i = 0; i < after.size(); ++i) k.change[i] = after[i] - before[i];
        if (count_ < kDepth) ++count_;
        for (int i = 0; i < count_; ++i)
            products_(i, next_) = products_(next_, i) = dot(k.change, known_[i].change);
        next_ = (next_ + 1) % kDepth;
    }

    /// The next step from where d is.
    template <class Dot>
    void find(const Rows& d, Rows& step, Dot dot) const {
        step = d;
        if (empty()) return;
        Small system = products_.topLeftCorner(count_, count_);
        Column share(count_);
        for (int i = 0; i < count_; ++i) share[i] = dot(known_[i].change, d);
        system.diagonal().array() += kRounding * system.trace();
        share = system.ldlt().solve(share);
        for (int i = 0; i < count_; ++i)
            for (std::size_t row = 0; row < d.size(); ++row)
                step[row] -= share[i] * (known_[i].step[row] + known_[i].change[row]);
    }

private:
    static constexpr int kDepth = 6;
    static constexpr double kRounding = 1e-12;
    using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kDepth, kDepth>;
    using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kDepth, 1>;
    struct Known {
        Rows step, change;
    };

    std::array<Known, kDepth> known_;
    Eigen::Matrix<double, kDepth, kDepth> products_ = Eigen::Matrix<double, kDepth, kDepth>::Zero();
    int count_ = 0, next_ = 0;
};

}  // namespace plumb
