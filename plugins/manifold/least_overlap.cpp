// SPDX-License-Identifier: MIT
#include "manifold/least_overlap.h"

#include "manifold/ball_contact.h"
#include "manifold/support.h"

namespace plumb {
namespace {

constexpr int kClimbs = 3;          ///< starts that are followed to their top
constexpr double kFirstStep = 0.3;  ///< of a climb [rad]
constexpr double kLastStep = 1e-6;  ///< [rad]
constexpr int kMostMoves = 200;     ///< of a climb

struct Way {
    Vec3 normal;
    double gap = -1e300;  ///< support gap along it [m]
};

/// The best starts, the best first.
struct Starts {
    Way best[kClimbs];

    void offer(const Way& way) {
        for (int i = 0; i < kClimbs; ++i) {
            if (way.gap <= best[i].gap + 1e-9) continue;
            for (int k = kClimbs - 1; k > i; --k) best[k] = best[k - 1];
            best[i] = way;
            return;
        }
    }
};

/// Axes, then edges and corners of a cube in each frame.
Starts starts_of(const Part& a, const Part& b) {
    Starts starts;
    for (int zeros = 2; zeros >= 0; --zeros)
        for (const Part* part : {&a, &b})
            for (int code = 0; code < 27; ++code) {
                const int x = code % 3 - 1, y = code / 3 % 3 - 1, z = code / 9 - 1;
                if ((x == 0) + (y == 0) + (z == 0) != zeros) continue;
                const Vec3 own{double(x), double(y), double(z)};
                const Vec3 n = unit_or(rotated(part->world, own), {0, 1, 0});
                starts.offer({n, support_gap(a, b, n)});
            }
    return starts;
}

/// Turns the normal by ever smaller steps to where the gap is greatest nearby.
Way climb(Way way, const Part& a, const Part& b) {
    const double least_gain = 1e-9 * (size_of(a) + size_of(b));
    double step = kFirstStep;
    for (int moves = 0; step > kLastStep && moves < kMostMoves; ++moves) {
        const Vec3 u = any_perpendicular(way.normal), w = cross(way.normal, u);
        Way best = way;
        for (int i = 0; i < 8; ++i) {
            const double angle = M_PI / 4 * i;
            const Vec3 aside = std::cos(angle) * u + std::sin(angle) * w;
            const Vec3 n = unit_or(way.normal + step * aside, way.normal);
            const double gap = support_gap(a, b, n);
            if (gap > best.gap + least_gain) best = {n, gap};
        }
        if (best.gap > way.gap)
            way = best;
        else
            step *= 0.5;
    }
    return way;
}

}  // namespace

Witness least_overlap(const Part& a, const Part& b) {
    const Vec3 middle = 0.5 * (a.world.origin + b.world.origin);
    double gap;
    Vec3 normal;
    if (closed_form_gap(gap, normal, a, b)) return {normal, middle, gap, false, true};
    const Starts starts = starts_of(a, b);
    Way best;
    for (const Way& start : starts.best) {
        const Way top = climb(start, a, b);
        if (top.gap > best.gap + 1e-9) best = top;
    }
    return {best.normal, middle, best.gap, true, true};
}

bool axes_part(const Part& a, const Part& b, double by) {
    // most often one that looks from b towards a does
    const Vec3 way = a.world.origin - b.world.origin;
    for (const bool towards : {true, false})
        for (const Part* part : {&a, &b})
            for (const Vec3& axis : part->world.axis) {
                const Vec3 n = (dot(axis, way) >= 0) == towards ? axis : -axis;
                if (support_gap(a, b, n) > by) return true;
            }
    return false;
}

}  // namespace plumb
