// SPDX-License-Identifier: MIT
/// The grid of a "repeat", over whose places bodies or deformables are dealt.
#pragma once

#include "math/random.h"
#include "reader/drafts.h"

namespace plumb::reader {

struct Grid {
    std::array<std::uint32_t, 3> count{1, 1, 1};
    Eigen::Vector3d spacing = Eigen::Vector3d::Ones();  ///< [m]
    Eigen::Vector3d origin =
        Eigen::Vector3d::Zero();  ///< of place 0, or of the middle on centred axes [m]
    std::array<bool, 3> centered{false, false, false};
    std::optional<std::uint32_t> total;
    Eigen::Vector3d jitter = Eigen::Vector3d::Zero();  ///< greatest displacement either way [m]
    bool random_rotation = false;
    std::uint64_t seed = 1;
};

const Table<Grid>& grid_table();

/// How many places are used; fails where the grid has not so many.
std::uint64_t total_of(const Grid& grid, const Node& node);

/// Which of the weights each place gets: [total], in their proportion, shuffled.
std::vector<std::size_t> dealt(const std::vector<double>& weights, std::size_t total,
                               Random& random);

/// A place of the grid, with its jitter and its rotation.
Placement drawn_place(const Grid& grid, std::size_t index, Random& random);

/// What a "repeat" deals more or less often.
inline constexpr Range kWeight{1e-6, 1e6};

}  // namespace plumb::reader
