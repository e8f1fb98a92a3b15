// SPDX-License-Identifier: MIT
/// Triangles eight by eight, looked at side by side from a point: how far each is at the least, and
/// whether the point may face it.
///
/// On a fine sheet that falls fast a point may come near hundreds of triangles in a step, of which
/// but the nearest count, and those that it faces. All is told in floats against an origin nearby,
/// and errs on the side of looking at a triangle too many.
#pragma once

#include "math/types.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace plumb {

class Facets {
public:
    static constexpr std::uint32_t kGroup = 8;  ///< side by side

    void resize(std::size_t triangles) { groups_.resize((triangles + kGroup - 1) / kGroup); }

    /// A triangle at its place: its box, and its unit normal or zero; [m] from the origin.
    void set(std::uint32_t place, const Vector3d& low, const Vector3d& high, const Vector3d& corner,
             const Vector3d& normal) {
        Group& group = groups_[place / kGroup];
        const std::uint32_t lane = place % kGroup;
        for (int k = 0; k < 3; ++k) {
            group.low[k][lane] = lower(low[k]);
            group.high[k][lane] = -lower(-high[k]);
            group.normal[k][lane] = static_cast<float>(normal[k]);
        }
        group.offset[lane] = static_cast<float>(normal.dot(corner));
    }

    static constexpr double kFacing = 0.99;  ///< a cosine

    /// What a point sees of a group.
    struct Sight {
        alignas(16) float square[kGroup];  ///< they are no nearer than the root of this [m²]
        /// To whose normals, one way or the other, its direction may be nearer than kFacing: one
        /// bit each.
        std::uint32_t may_face = 0;
    };

    /// `point`: from the origin [m]
    Sight look(std::uint32_t group_at, const Vector3d& point) const {
        const Group& group = groups_[group_at];
        Sight sight;
        const float x[3] = {float(point[0]), float(point[1]), float(point[2])};
        const float all = std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]);
        const Four none{}, rounding = none + all * kRounding;
        for (std::uint32_t first = 0; first < kGroup; first += 4) {
            Four square{}, along = none - read(group.offset + first);
            const Four offset = along < none ? none - along : along;
            for (int k = 0; k < 3; ++k) {
                const Four below = read(group.low[k] + first) - x[k],
                           above = x[k] - read(group.high[k] + first);
                const Four gap = (below > above ? below : above) - rounding;
                const Four apart = gap > none ? gap : none;
                square += apart * apart;
                along += read(group.normal[k] + first) * x[k];
            }
            const Four height =
                (along < none ? none - along : along) + rounding + offset * kRounding;
            sight.may_face |= bits(height * height >= square * kLeastFacing) << first;
            square *= kNearly;
            __builtin_memcpy(sight.square + first, &square, sizeof square);
        }
        return sight;
    }

private:
    using Four = float __attribute__((vector_size(16)));
    using Mask = std::int32_t __attribute__((vector_size(16)));
    struct alignas(64) Group {
        float low[3][kGroup], high[3][kGroup], normal[3][kGroup], offset[kGroup];
    };

    /// Shares of numbers that are more than their rounding; and kFacing², with some to spare.
    static constexpr float kRounding = 2e-6f, kNearly = 1 - 1e-5f, kLeastFacing = 0.97f;

    static Four read(const float* from) {
        Four x;
        __builtin_memcpy(&x, from, sizeof x);
        return x;
    }
    static std::uint32_t bits(Mask mask) {
        mask &= Mask{1, 2, 4, 8};
        return static_cast<std::uint32_t>(mask[0] | mask[1] | mask[2] | mask[3]);
    }
    static float lower(double x) {
        const auto near = static_cast<float>(x);
        return near - std::abs(near) * 2e-7f;
    }

    std::vector<Group> groups_;
};

}  // namespace plumb
