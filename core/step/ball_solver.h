// SPDX-License-Identifier: MIT
/// Ball joints of one precision and lane width. Colours are found once, for joints do not change.
#pragma once

#include "kernels/ball_kernels.h"
#include "schedule/colouring.h"
#include "schedule/workers.h"
#include "step/fill_mass.h"
#include "step/velocity_table.h"
#include "world/world.h"

#include <vector>

namespace plumb {

template <class Real, int W>
class BallSolver {
public:
    BallSolver(const World& world, Workers& workers)
        : kernels_(ball_kernels<Real, W>()), workers_(workers) {
        std::vector<BodyPair> pairs;
        for (std::uint32_t i = 0; i < world.joints.size(); ++i) {
            if (!world.joints.joints[i].is_plain_ball()) continue;
            joints_.push_back(i);
            pairs.push_back({world.bodies.row[world.joints.joints[i].a], row_b(world, i), i, 1, 0});
        }
        colouring_.colour(pairs, world.dynamic_count);
        lay_out(world, pairs);
    }

    bool empty() const { return places_.empty(); }

    /// Arms, gaps and masses at the start of a substep.
    void begin(const World& world) {
        const Bodies& bodies = world.bodies;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            BallBlock<Real, W>& block = blocks_[places_[i].block];
            const Joint& joint = world.joints.joints[joints_[i]];
            const std::uint32_t lane = places_[i].lane, a = joint.a, b = joint.b;
            const Vector3d arm_a = bodies.orientation[a] * joint.frame_a.position;
            Vector3d arm_b = Vector3d::Zero(), point_b = joint.frame_b.position;
            fill_mass(bodies, a, block.inverse_mass_a, block.inverse_inertia_a, lane);
            if (b != kNoIndex) {
                arm_b = bodies.orientation[b] * joint.frame_b.position;
                point_b = bodies.position[b] + arm_b;
                fill_mass(bodies, b, block.inverse_mass_b, block.inverse_inertia_b, lane);
            }
            const Vector3d gap = (bodies.position[a] + arm_a) - point_b;
            for (int k = 0; k < 3; ++k) {
                block.arm_a[k][lane] = static_cast<Real>(arm_a[k]);
                block.arm_b[k][lane] = static_cast<Real>(arm_b[k]);
                block.gap[k][lane] = static_cast<Real>(gap[k]);
            }
        }
    }

    void position_iteration(const BodyRows<Real>& bodies, Real h, bool forwards,
                            std::uint32_t worker) {
        for (std::size_t i = 0; i < ranges_.size(); ++i) {
            const BlockRange& range = ranges_[forwards ? i : ranges_.size() - 1 - i];
            Range share = workers_.share(range.last - range.first, worker);
            if (!range.independent)
                share = worker == 0 ? Range{0, range.last - range.first} : Range{0, 0};
            kernels_.solve_positions(blocks_.data(), bodies, h, range.first + share.first,
                                     range.first + share.last);
            workers_.barrier();
        }
    }

private:
    struct Place {
        std::uint32_t block, lane;
    };

    static std::int32_t row_b(const World& world, std::uint32_t joint) {
        const std::uint32_t b = world.joints.joints[joint].b;
        return b == kNoIndex ? world.zero_row() : world.bodies.row[b];
    }

    void lay_out(const World& world, const std::vector<BodyPair>& pairs) {
        places_.resize(pairs.size());
        for (const Batch& batch : colouring_.batches()) {
            const std::uint32_t width = batch.independent ? W : 1;
            const auto first = static_cast<std::uint32_t>(blocks_.size());
            for (std::uint32_t i = batch.first; i < batch.last; i += width) {
                blocks_.push_back({});
                BallBlock<Real, W>& block = blocks_.back();
                for (int lane = 0; lane < W; ++lane)
                    block.row_a[lane] = block.row_b[lane] = world.zero_row();
                for (std::uint32_t lane = 0; lane < width && i + lane < batch.last; ++lane) {
                    const std::uint32_t joint = colouring_.order()[i + lane];
                    places_[joint] = {static_cast<std::uint32_t>(blocks_.size()) - 1, lane};
                    block.row_a[lane] = pairs[joint].row_a;
                    block.row_b[lane] = pairs[joint].row_b;
                    block.used[lane] = 1;
                }
            }
            ranges_.push_back(
                {first, static_cast<std::uint32_t>(blocks_.size()), batch.independent});
        }
    }

    const BallKernels<Real, W>& kernels_;
    Workers& workers_;
    Colouring colouring_;
    std::vector<BallBlock<Real, W>> blocks_;
    std::vector<BlockRange> ranges_;
    std::vector<std::uint32_t> joints_;
    std::vector<Place> places_;
};

}  // namespace plumb
