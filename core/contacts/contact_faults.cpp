// SPDX-License-Identifier: MIT
#include "contacts/contact_faults.h"

#include "world/sleep.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

bool is_finite(const Contact& c) {
    const Vec3 &p = c.point_a, &q = c.point_b, &n = c.normal;
    return std::isfinite(c.gap + c.radius_a + c.radius_b + p.x + p.y + p.z + q.x + q.y + q.z + n.x +
                         n.y + n.z);
}

/// Whether the scene lets two bodies touch: one is dynamic, both have a shape, the filters agree
/// and no joint keeps them apart.
bool is_wanted(std::uint32_t a, std::uint32_t b, const World& world) {
    const Bodies& bodies = world.bodies;
    if (!is_movable(bodies.motion[a]) && !is_movable(bodies.motion[b])) return false;
    if (!(bodies.group[a] & bodies.mask[b]) || !(bodies.group[b] & bodies.mask[a])) return false;
    return !std::binary_search(world.excluded.begin(), world.excluded.end(), pair_key(a, b));
}

}  // namespace

ContactFault fault_of(const Contact& c, const World& world, const std::vector<double>& sweeps) {
    if (c.a >= c.b || c.b >= world.bodies.size()) return ContactFault::unknown_body;
    if (!is_finite(c)) return ContactFault::not_finite;
    if (std::abs(to_eigen(c.normal).squaredNorm() - 1) > 1e-6) return ContactFault::bad_normal;
    if (!is_wanted(c.a, c.b, world)) return ContactFault::unwanted_pair;
    // a thousandth of the margin more does no harm, and leaves room for rounding
    const double limit = 1.001 * world.settings.margin + sweeps[c.a] + sweeps[c.b];
    return c.gap <= limit ? ContactFault::none : ContactFault::too_far;
}

}  // namespace plumb
