// SPDX-License-Identifier: MIT
#include "manifold/least_overlap.h"

#include "manifold/support.h"

namespace plumb {

Witness least_overlap(const Part& a, const Part& b) {
    Witness best{{0, 1, 0}, 0.5 * (a.world.origin + b.world.origin), -1e300, true, true};
    for (const Part* part : {&a, &b})
        for (const Vec3& axis : part->world.axis)
            for (double side : {1.0, -1.0}) {
                const double gap = support_gap(a, b, side * axis);
                if (gap > best.gap + 1e-9) best.gap = gap, best.normal = side * axis;
            }
    return best;
}

}  // namespace plumb
