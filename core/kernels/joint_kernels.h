// SPDX-License-Identifier: MIT
/// The joints' kernels, over blocks that share no dynamic body.
#pragma once

#include "kernels/body_kernels.h"
#include "kernels/pair_residual.h"
#include "schedule/joint_blocks.h"

namespace plumb {

template <class Block, class Real>
using JointPass = void (*)(Block* blocks, const BodyRows<Real>& bodies, Real h, std::uint32_t first,
                           std::uint32_t last);

/// Finds the residuals of the blocks [first, last), and changes nothing else.
template <class Block, class Real, int W>
using JointResidualPass = void (*)(PairResidual<Real, W>* residuals, const Block* blocks,
                                   const BodyRows<Real>& bodies, Real h, std::uint32_t first,
                                   std::uint32_t last);

/// Arms, gaps and masses at the start of a substep of length h [s]; impulses start from nothing.
template <class Real, int W>
using BeginBalls = void (*)(BallBlock<Real, W>* blocks, const BallFrames<W>* frames,
                            const BodyStates& bodies, double h, std::size_t count);

template <class Real, int W>
struct JointKernels {
    BeginBalls<Real, W> begin_balls;
    // one position iteration each
    JointPass<BallBlock<Real, W>, Real> balls;
    JointPass<JointBlock<Real, W>, Real> joints;
    JointPass<DriveBlock<Real, W>, Real> drives;
    // after the last
    JointResidualPass<BallBlock<Real, W>, Real, W> ball_residuals;
    JointResidualPass<JointBlock<Real, W>, Real, W> joint_residuals;
    JointResidualPass<DriveBlock<Real, W>, Real, W> drive_residuals;
};

template <class Real, int W>
const JointKernels<Real, W>& joint_kernels();

}  // namespace plumb
