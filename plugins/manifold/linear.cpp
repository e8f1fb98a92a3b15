// SPDX-License-Identifier: MIT
#include "manifold/linear.h"

#include <limits>

namespace plumb {

Frame frame_of(const Pose& pose) {
    const Quat& q = pose.rotation;
    const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    const double s = length > 1e-9 ? 1 / length : std::numeric_limits<double>::quiet_NaN();
    const double x = s * q.x, y = s * q.y, z = s * q.z, w = s * q.w;
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
             {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
             {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}},
            pose.position};
}

Quat quaternion_of(const Frame& frame) {
    // Start from the largest of the four components, which keeps the division well away from zero.
    const Vec3* a = frame.axis;
    const double trace = a[0].x + a[1].y + a[2].z;
    if (trace > 0) {
        const double w = 0.5 * std::sqrt(1 + trace), s = 0.25 / w;
        return {s * (a[1].z - a[2].y), s * (a[2].x - a[0].z), s * (a[0].y - a[1].x), w};
    }
    int i = 0;
    if (a[1].y > a[0].x) i = 1;
    if (a[2].z > at(a[i], i)) i = 2;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double root = std::sqrt(std::max(1e-30, 1 + at(a[i], i) - at(a[j], j) - at(a[k], k)));
    const double s = 0.5 / root;
    Vec3 v{};
    at(v, i) = 0.5 * root;
    at(v, j) = s * (at(a[i], j) + at(a[j], i));
    at(v, k) = s * (at(a[i], k) + at(a[k], i));
    return {v.x, v.y, v.z, s * (at(a[j], k) - at(a[k], j))};
}

}  // namespace plumb
