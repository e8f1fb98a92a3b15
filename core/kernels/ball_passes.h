// SPDX-License-Identifier: MIT
/// The loop behind the ball joints' kernel. Included by the units of each instruction set and by
/// nothing else.
#pragma once

#include "constraints/point.h"
#include "kernels/ball_kernels.h"
#include "kernels/gather.h"

namespace plumb::kernels {

template <class T>
inline Velocity<T> sum(const Velocity<T>& x, const Velocity<T>& y) {
    return {x.v + y.v, x.w + y.w};
}

template <class Real, int W>
void solve_balls(const BallBlock<Real, W>* blocks, const BodyRows<Real>& bodies, Real h,
                 std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    for (std::uint32_t i = first; i < last; ++i) {
        const BallBlock<Real, W>& block = blocks[i];
        auto symmetric = [](const Real(&m)[6][W]) {
            return Symmetric3<T>{load(m[0]), load(m[1]), load(m[2]),
                                 load(m[3]), load(m[4]), load(m[5])};
        };
        // an empty lane has unit mass and no gap, so that its 3 × 3 system can be solved
        const T empty = T(1) - load(block.used);
        const InverseMass<T> mass_a{load(block.inverse_mass_a) + empty,
                                    symmetric(block.inverse_inertia_a)};
        const InverseMass<T> mass_b{load(block.inverse_mass_b), symmetric(block.inverse_inertia_b)};

        Velocity<T> a = read_velocities<Real, W>(bodies.change, block.row_a);
        Velocity<T> b = read_velocities<Real, W>(bodies.change, block.row_b);
        const Velocity<T> total_a = sum(a, read_velocities<Real, W>(bodies.start, block.row_a));
        const Velocity<T> total_b = sum(b, read_velocities<Real, W>(bodies.start, block.row_b));
        join<T>(a, b, total_a, total_b, mass_a, mass_b, load_vector(block.arm_a),
                load_vector(block.arm_b), load_vector(block.gap), T(h));

        write_velocities<Real, W>(bodies.change, block.row_a, bodies.dynamic_count, a);
        write_velocities<Real, W>(bodies.change, block.row_b, bodies.dynamic_count, b);
    }
}

}  // namespace plumb::kernels
