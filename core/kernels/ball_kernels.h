// SPDX-License-Identifier: MIT
/// The ball joints' kernel: one position iteration over blocks that share no dynamic body.
#pragma once

#include "schedule/ball_rows.h"

namespace plumb {

template <class Real, int W>
struct BallKernels {
    void (*solve_positions)(const BallBlock<Real, W>* blocks, const BodyRows<Real>& bodies, Real h,
                            std::uint32_t first, std::uint32_t last);
};

template <class Real, int W>
const BallKernels<Real, W>& ball_kernels();

}  // namespace plumb
