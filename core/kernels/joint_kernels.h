// SPDX-License-Identifier: MIT
/// The joints' kernels, over blocks that share no dynamic body.
#pragma once

#include "schedule/joint_blocks.h"

namespace plumb {

template <class Block, class Real>
using JointPass = void (*)(Block* blocks, const BodyRows<Real>& bodies, Real h, std::uint32_t first,
                           std::uint32_t last);

/// One position iteration each.
template <class Real, int W>
struct JointKernels {
    JointPass<BallBlock<Real, W>, Real> balls;
    JointPass<JointBlock<Real, W>, Real> joints;
    JointPass<DriveBlock<Real, W>, Real> drives;
};

template <class Real, int W>
const JointKernels<Real, W>& joint_kernels();

}  // namespace plumb
