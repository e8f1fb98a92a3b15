// SPDX-License-Identifier: MIT
/// The tables of the joints' kernels. Included by the units of each instruction set and by nothing
/// else.
#pragma once

#include "kernels/joint_passes.h"
#include "kernels/joint_residuals.h"

namespace plumb::kernels {

template <class Real, int W>
constexpr JointKernels<Real, W> all_joint_kernels() {
    return {begin_balls<Real, W>,         solve_balls<Real, W>,
            solve_joints<Real, W>,        solve_drives<Real, W>,
            find_ball_residuals<Real, W>, find_joint_residuals<Real, W>,
            find_drive_residuals<Real, W>};
}

}  // namespace plumb::kernels
