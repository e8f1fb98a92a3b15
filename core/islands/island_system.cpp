// SPDX-License-Identifier: MIT
#include "islands/island_system.h"

#include "kernels/front_kernels.h"
#include "math/growing.h"

namespace plumb {
namespace {

/// Multiplications of a product of two 6 × 6 blocks.
constexpr double kOfProduct = 216;

}  // namespace

bool IslandSystem::analyse(std::uint32_t rows, const Pattern& pattern, bool many,
                           std::uint64_t most, Spare& spare) {
    const auto give_back = [&] {
        if (fronts_) spare = std::move(fronts_);
    };
    if (!many) {
        give_back();
        return blocks_.analyse(rows, pattern, most);
    }
    blocks_.analyse(0, {});
    if (!fronts_) fronts_ = std::move(spare);
    if (!fronts_) fronts_ = std::make_unique<SparseLdlt>(front_kernels());
    if (analyse_many(rows, pattern, most)) return true;
    give_back();
    return false;
}

bool IslandSystem::analyse_many(std::uint32_t rows, const Pattern& pattern, std::uint64_t most) {
    pairs_.clear();
    for (std::uint32_t i = 0; i < rows; ++i) pairs_.emplace_back(2 * i, 2 * i + 1);
    for (const auto& [i, j] : pattern)
        if (i != j)
            for (std::uint32_t k = 0; k < 4; ++k) pairs_.emplace_back(2 * i + k / 2, 2 * j + k % 2);
    return fronts_->order(2 * rows, pairs_, kOfProduct * static_cast<double>(most));
}

std::uint64_t IslandSystem::block_products() const {
    if (!fronts_) return blocks_.block_products();
    return static_cast<std::uint64_t>(fronts_->work() / kOfProduct) + 1;
}

void IslandSystem::add_product(std::uint32_t i, const Vector6d& x, std::uint32_t j,
                               const Vector6d& y) {
    if (!fronts_)
        blocks_.add_product(i, x, j, y);
    else if (i == j)
        add_to_fronts(i, x * y.transpose());
    else
        add_to_fronts(i, j, x * y.transpose());
}

void IslandSystem::add_to_fronts(std::uint32_t i, const Matrix6d& block) {
    fronts_->add(2 * i, block.topLeftCorner<3, 3>());
    fronts_->add(2 * i + 1, block.bottomRightCorner<3, 3>());
    fronts_->add(fronts_->slot(2 * i + 1, 2 * i), block.bottomLeftCorner<3, 3>());
}

void IslandSystem::add_to_fronts(std::uint32_t i, std::uint32_t j, const Matrix6d& block) {
    for (std::uint32_t a = 0; a < 2; ++a)
        for (std::uint32_t b = 0; b < 2; ++b)
            fronts_->add(fronts_->slot(2 * i + a, 2 * j + b), block.block<3, 3>(3 * a, 3 * b));
}

void IslandSystem::solve(std::vector<Vector6d>& x) {
    if (!fronts_) return blocks_.solve(x);
    size_anew(halves_, 2 * x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        halves_[2 * i] = x[i].head<3>(), halves_[2 * i + 1] = x[i].tail<3>();
    fronts_->solve(halves_);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] << halves_[2 * i], halves_[2 * i + 1];
}

}  // namespace plumb
