// SPDX-License-Identifier: MIT
/// Loose stones that statics says must stand.
#include "reader/shapes/polyhedra.h"
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/contact_forces.h"
#include "study/judges.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace plumb::study {
namespace {

constexpr double kDepth = 0.5;  ///< along z [m]

/// Adds a stone of an arch about the origin: between two angles [rad] and two radii [m].
BodySpec& add_voussoir(Scene& scene, double from, double to, double inner, double outer) {
    std::vector<Vector3d> corners;
    Vector3d middle = Vector3d::Zero();
    for (const double angle : {from, to})
        for (const double radius : {inner, outer})
            for (const double z : {-kDepth / 2, kDepth / 2}) {
                corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
                middle += corners.back() / 8;
            }
    for (Vector3d& corner : corners) corner -= middle;
    return add_body(scene, reader::hull_geometry(corners), middle);
}

/// By how much what the bodies from `first` on push up differs from the weight of those before.
double support_error(const World& w, std::uint32_t first) {
    double weight = 0, support = 0;
    for (std::uint32_t i = 0; i < first; ++i) weight += w.bodies.mass[i] * kGravity;
    for (std::uint32_t i = first; i < w.bodies.size(); ++i) support -= contact_force_on(w, i).y();
    return support / weight - 1;
}

}  // namespace

/// Of a semicircle a thickness of 0.1075 of the radius is the least that stands, where friction
/// suffices (Milankovitch 1907).
Subject arch() {
    Subject s = begin_subject("arch", "A semicircle of 21 loose stones stands",
                              "the line of thrust fits in; the abutments bear the weight", 3);
    constexpr double kRadius = 2, kInner = 1.85, kOuter = 2.15;  // [m]
    constexpr std::uint32_t kStones = 21;
    const double pitch = std::numbers::pi / kStones;
    for (std::uint32_t i = 0; i < kStones; ++i)
        add_voussoir(s.scene, i * pitch, (i + 1) * pitch, kInner, kOuter);
    for (const double from : {-pitch, std::numbers::pi})
        add_voussoir(s.scene, from, from + pitch, kInner - 0.2, kOuter + 0.2).motion =
            Motion::fixed;
    s.scene.materials[0].friction = 0.6;
    s.metrics = {shift_metric("farthest that a stone has moved, of the span", 2 * kRadius),
                 last("force", "", "error of what the abutments bear in the end",
                      [](const World& w) { return support_error(w, kStones); })};
    s.tolerance = 1e-10;
    return s;
}

/// Courses of bricks in running bond; half bricks end every other one.
Subject wall() {
    Subject s = begin_subject("wall", "A wall of 40 × 11 loose bricks stands",
                              "nothing pushes it; the ground bears the weight", 2);
    use_coarse_steps(s);
    constexpr std::uint32_t kBricks = 40, kCourses = 11;
    const Vector3d half(0.1, 0.035, 0.05);
    for (std::uint32_t course = 0; course < kCourses; ++course) {
        const double y = half.y() * (2 * course + 1);
        const bool is_odd = course % 2 == 1;
        for (std::uint32_t i = 0; i < kBricks - (is_odd ? 1 : 0); ++i)
            add_body(s.scene, box(half), {half.x() * (2 * i + (is_odd ? 2 : 1)), y, 0});
        if (!is_odd) continue;
        for (const double x : {0.5 * half.x(), half.x() * (2 * kBricks - 0.5)})
            add_body(s.scene, box(0.5 * half.x(), half.y(), half.z()), {x, y, 0});
    }
    const auto ground = static_cast<std::uint32_t>(s.scene.bodies.size());
    add_ground(s.scene);
    s.metrics = {shift_metric("farthest that a brick has moved, of its length", 2 * half.x()),
                 last("force", "", "error of what the ground bears in the end",
                      [ground](const World& w) { return support_error(w, ground); })};
    s.tolerance = 1.5e-8;
    return s;
}

}  // namespace plumb::study
