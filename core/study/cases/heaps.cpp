// SPDX-License-Identifier: MIT
/// What falls into a heap.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/gauges.h"
#include "study/judges.h"

#include <cmath>
#include <numbers>

namespace plumb::study {
namespace {

/// The k-th number of a sequence that fills [−1, 1] evenly, whatever k is counted up to.
double spread(std::uint32_t k) { return 2 * std::fmod(k * std::numbers::phi, 1.0) - 1; }

double mean_speed(const World& w) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < w.bodies.size(); ++i)
        if (w.bodies.motion[i] == Motion::dynamic) sum += w.bodies.velocity[i].norm(), ++count;
    return sum / count;
}

}  // namespace

/// How a heap falls cannot be predicted, but for what holds of any: bodies do not overlap, and rest
/// in the end.
Subject pile() {
    Subject s = begin_subject("pile", "490 boxes and balls fall between four walls",
                              "nothing overlaps, and all rests in the end", 5);
    use_coarse_steps(s);
    add_ground(s.scene);
    constexpr double kRoom = 2.2;  // half of what the walls leave [m]
    for (const double side : {-1.0, 1.0}) {
        add_body(s.scene, box(0.5, 5, kRoom + 1), {side * (kRoom + 0.5), 5, 0}, Motion::fixed);
        add_body(s.scene, box(kRoom + 1, 5, 0.5), {0, 5, side * (kRoom + 0.5)}, Motion::fixed);
    }
    std::uint32_t k = 0;
    for (int layer = 0; layer < 10; ++layer)
        for (int x = -3; x <= 3; ++x)
            for (int z = -3; z <= 3; ++z, ++k) {
                const Vector3d at(0.6 * x + 0.02 * spread(k), 0.5 + 0.6 * layer,
                                  0.6 * z + 0.02 * spread(3 * k + 1));
                if (k % 2 == 0) {
                    add_body(s.scene, sphere(0.25), at);
                    continue;
                }
                const Vector3d axis(spread(5 * k), spread(7 * k + 1), spread(11 * k + 2));
                add_body(s.scene, box(Vector3d::Constant(0.2)), at).placement.rotation =
                    Quaterniond(Eigen::AngleAxisd(3 * spread(k), axis.normalized()));
            }
    s.metrics = {
        mean_over_time("penetration", "m", "mean depth of pairs that penetrate", mean_penetration),
        last("speed", "m/s", "mean speed in the end", mean_speed)};
    s.tolerance = 5e-4;
    return s;
}

}  // namespace plumb::study
