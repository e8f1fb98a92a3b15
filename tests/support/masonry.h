// SPDX-License-Identifier: MIT
/// Arches of loose stones, and what statics says of them.
#pragma once

#include "reader/shapes/polyhedra.h"
#include "support/scenes.h"

#include <vector>

namespace plumb::test {

/// A closed outline in the plane of an arch, counter-clockwise [m].
using Outline = std::vector<Eigen::Vector2d>;

/// Its area [m²] and centroid [m].
struct OutlineSums {
    double area = 0;
    Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
};
inline OutlineSums sums_of(const Outline& outline) {
    OutlineSums sums;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector2d &p = outline[i], &q = outline[(i + 1) % outline.size()];
        const double area = 0.5 * (p.x() * q.y() - p.y() * q.x());
        sums.area += area;
        sums.centroid += area * (p + q) / 3;
    }
    sums.centroid /= sums.area;
    return sums;
}

/// A prism over an outline, `width` deep about z, with the outline's centroid for its place.
inline BodySpec& add_prism(Scene& scene, const Outline& outline, double width, double z = 0) {
    const Eigen::Vector2d centre = sums_of(outline).centroid;
    std::vector<Vector> corners;
    for (const Eigen::Vector2d& p : outline)
        for (const double side : {-0.5, 0.5})
            corners.emplace_back(p.x() - centre.x(), p.y() - centre.y(), side * width);
    return add_body(scene, reader::hull_geometry(corners), {centre.x(), centre.y(), z});
}

/// A symmetric arch of an odd number of equal stones about the origin.
struct Arch {
    int stones = 21;
    double radius = 2, thickness = 0.3;  ///< of the middle of the ring [m]
    double half = std::numbers::pi / 2;  ///< angle from the crown to the springings [rad]
    double width = 0.5;                  ///< along z [m]

    double inner() const { return radius - thickness / 2; }
    double outer() const { return radius + thickness / 2; }
    /// Of the joint before stone i, counted from the right springing; x runs to the right.
    double joint(int i) const { return std::numbers::pi / 2 - half + 2 * half * i / stones; }
    Outline between(double from, double to) const { return between(from, to, inner(), outer()); }
    static Outline between(double from, double to, double inner, double outer) {
        const Eigen::Vector2d p(std::cos(from), std::sin(from)), q(std::cos(to), std::sin(to));
        return {inner * p, outer * p, outer * q, inner * q};
    }
};

/// Its stones, then two fixed abutments.
inline void add_arch(Scene& scene, const Arch& arch, double z = 0) {
    for (int i = 0; i < arch.stones; ++i)
        add_prism(scene, arch.between(arch.joint(i), arch.joint(i + 1)), arch.width, z);
    for (const bool left : {false, true}) {
        const double springing = arch.joint(left ? arch.stones : 0);
        const double from = left ? springing : springing - 0.2, to = from + 0.2;
        const Outline outline =
            Arch::between(from, to, arch.inner() - arch.thickness, arch.outer() + arch.thickness);
        add_prism(scene, outline, 2 * arch.width, z).motion = Motion::fixed;
    }
}

/// Whether forces between its stones can bear them: the safe theorem of limit analysis (Heyman
/// 1966), with Coulomb friction. By symmetry the left half pushes the right one sideways, by H with
/// a moment M about the origin; then each joint's force follows, and has to pass through the joint
/// within the cone of friction. For each H that leaves an interval for M.
inline bool can_stand(const Arch& arch, double friction) {
    const int crown = arch.stones / 2;
    struct Joint {
        double angle, weight, moment;  // of what is above it on its side
    };
    std::vector<Joint> joints;
    double weight = 0, moment = 0;
    for (int i = crown; i >= 0; --i) {
        Outline stone = arch.between(arch.joint(i), arch.joint(i + 1));
        if (i == crown)  // its right half
            stone[2] = {0, stone[1].y()}, stone[3] = {0, stone[0].y()};
        const OutlineSums sums = sums_of(stone);
        weight += sums.area, moment += sums.area * sums.centroid.x();
        joints.push_back({arch.joint(i), weight, moment});
    }
    constexpr int kTries = 20000;
    for (int k = 0; k < kTries; ++k) {
        const double thrust = weight * std::pow(10, -2 + 4.0 * k / kTries);
        double least = -1e9, most = 1e9;
        for (const Joint& j : joints) {
            const double s = std::sin(j.angle), c = std::cos(j.angle);
            const double normal = thrust * s + j.weight * c;
            const double along = j.weight * s - thrust * c;
            if (std::abs(along) > friction * normal) most = least - 1;
            least = std::max(least, arch.inner() * normal - j.moment);
            most = std::min(most, arch.outer() * normal - j.moment);
        }
        if (least <= most) return true;
    }
    return false;
}

/// The least value in [low, high] of which `stands` is true, which it is from there on.
template <class Stands>
double least_that(double low, double high, Stands stands) {
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (stands(middle) ? high : low) = middle;
    }
    return high;
}

inline double least_friction(const Arch& arch) {
    return least_that(0, 10, [&](double friction) { return can_stand(arch, friction); });
}
inline double least_thickness(Arch arch, double friction) {
    return least_that(1e-3 * arch.radius, arch.radius, [&](double thickness) {
        arch.thickness = thickness;
        return can_stand(arch, friction);
    });
}

}  // namespace plumb::test
