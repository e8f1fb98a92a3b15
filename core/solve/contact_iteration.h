// SPDX-License-Identifier: MIT
/// Iterations over batches of contact rows, and what both kinds of contacts read from a row.
#pragma once

#include "kernels/contact_kernels.h"
#include "math/types.h"
#include "schedule/contact_batches.h"
#include "schedule/workers.h"

namespace plumb {

/// The unit tangents of a row, world frame.
struct ContactTangents {
    Vector3d x, y;
};
template <class Real, int W>
inline ContactTangents tangents_of(const NormalRow<Real, W>& row,
                                   const FrictionRow<Real, W>& across, std::uint32_t lane) {
    const Vector3d n(row.normal[0][lane], row.normal[1][lane], row.normal[2][lane]);
    const Vector3d x(across.tangent[0][lane], across.tangent[1][lane], across.tangent[2][lane]);
    return {x, n.cross(x)};
}

/// What a row bears in a substep, both passes together: along the normal, and along the tangents x
/// and y [N s].
struct RowImpulse {
    double normal, x = 0, y = 0;
    ContactTangents tangents{Vector3d::Zero(), Vector3d::Zero()};

    Vector3d friction() const { return x * tangents.x + y * tangents.y; }
};
template <class Real, int W>
inline RowImpulse impulse_of(const ContactArrays<Real, W>& rows, std::uint32_t k,
                             std::uint32_t lane) {
    const NormalRow<Real, W>& row = rows.normals[k];
    RowImpulse p{double(row.lambda_velocity[lane]) + double(row.lambda_position[lane])};
    if (!rows.frictions) return p;
    const FrictionRow<Real, W>& across = rows.frictions[k];
    p.tangents = tangents_of(row, across, lane);
    p.x = double(across.lambda_velocity_x[lane]) + double(across.lambda_position_x[lane]);
    p.y = double(across.lambda_velocity_y[lane]) + double(across.lambda_position_y[lane]);
    return p;
}

/// Calls a kernel on the blocks of a batch that is solved in order, forwards or backwards.
template <class Real, int W>
inline void solve_in_order(ContactPass<Real, W> kernel, const ContactArrays<Real, W>& rows,
                           const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                           const BlockRange& range) {
    if (pass.forwards) return kernel(rows, bodies, pass, range.first, range.last);
    for (std::uint32_t b = range.last; b > range.first; --b) kernel(rows, bodies, pass, b - 1, b);
}

/// One batch: every worker takes its share of blocks that are independent, and waits for the
/// others.
template <class Real, int W>
inline void solve_batch(ContactPass<Real, W> kernel, const ContactArrays<Real, W>& rows,
                        const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                        const BlockRange& range, Workers& workers, std::uint32_t worker) {
    if (range.independent) {
        const Range share = workers.share(range.last - range.first, worker);
        kernel(rows, bodies, pass, range.first + share.first, range.first + share.last);
    } else if (worker == 0) {
        solve_in_order(kernel, rows, bodies, pass, range);
    }
    workers.barrier();
}

/// One pass over ranges of blocks in order, or backwards.
template <class Real, int W>
inline void iterate_ranges(ContactPass<Real, W> kernel, const ContactArrays<Real, W>& rows,
                           const std::vector<BlockRange>& ranges, const BodyRows<Real>& bodies,
                           const PassSettings<Real>& pass, Workers& workers, std::uint32_t worker) {
    for (std::size_t i = 0; i < ranges.size(); ++i)
        solve_batch(kernel, rows, bodies, pass, ranges[pass.forwards ? i : ranges.size() - 1 - i],
                    workers, worker);
}

/// The same over all batches.
template <class Real, int W>
inline void iterate_batches(ContactPass<Real, W> kernel, ContactBatches<Real, W>& batches,
                            const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                            Workers& workers, std::uint32_t worker) {
    iterate_ranges(kernel, batches.arrays(), batches.ranges(), bodies, pass, workers, worker);
}

}  // namespace plumb
