// SPDX-License-Identifier: MIT
/// The kernels of bodies that hang by balls in trees (trees/tree_solver.h), over blocks in which no
/// two share a parent.
#pragma once

#include "kernels/body_kernels.h"
#include "schedule/tree_blocks.h"

namespace plumb {

template <int W>
struct TreeKernels {
    using Balls = TreeBalls<kBodyLanes<W>>;

    /// `lift`: what the joints of bodies that are held are taken to give them at first [m/s];
    /// `most`: how much of an old gap is closed at the most [m].
    void (*begin)(Balls* blocks, std::size_t count, const BodyStates& bodies, double h,
                  const double (&lift)[3], double most);
    /// Returns the greatest gap [m].
    double (*evaluate)(Balls* blocks, std::size_t count, const TreeColumns& tables, double h);
    /// `first`: no other child of the parents has been eliminated; `leaves`: there are no children.
    void (*eliminate)(Balls* blocks, std::size_t count, const TreeColumns& tables, double h,
                      bool balance, bool first, bool leaves);
    void (*substitute)(Balls* blocks, std::size_t count, const TreeColumns& tables, double h,
                       bool balance);
};

template <int W>
const TreeKernels<W>& tree_kernels();

}  // namespace plumb
