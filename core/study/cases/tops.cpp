// SPDX-License-Identifier: MIT
/// Bodies that spin: free ones, and a flywheel on its pivot.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/free_top.h"
#include "study/judges.h"
#include "world/bodies.h"

#include <cmath>

namespace plumb::study {
namespace {

/// A box that spins in free space, alone; I₁ < I₂ < I₃. Nothing asks for substeps. Free turns are
/// of fourth order until rounding hides it.
struct SpinningBox {
    Vector3d half{0.3, 0.2, 0.1}, spin;  ///< [m], [rad/s]
    FreeTop top{inertia(), spin};

    explicit SpinningBox(const Vector3d& spin_) : spin(spin_) {}

    /// Principal moments of three units of mass.
    Vector3d inertia() const {
        const Vector3d s = half.cwiseProduct(half);
        return {s[1] + s[2], s[0] + s[2], s[0] + s[1]};
    }
    Vector3d spin_of(const World& w) const {
        return geometry_placement(w.bodies, 0).rotation.conjugate() * w.bodies.angular_velocity[0];
    }
    Vector3d momentum_of(const World& w) const {
        return geometry_placement(w.bodies, 0).rotation * inertia().cwiseProduct(spin_of(w));
    }
};

Scene scene_of(Scene scene, const SpinningBox& b) {
    scene.settings.gravity.setZero();
    scene.settings.substeps = 1;
    add_body(scene, box(b.half), Vector3d::Zero()).angular_velocity = b.spin;
    return scene;
}

Metric spin_metric(const SpinningBox& b) {
    return largest("spin", "", "largest error of the angular velocity, seen from the body",
                   [b](const World& w) {
                       const Vector3d off = b.spin_of(w) - b.top.angular_velocity(w.time);
                       return off.norm() / b.spin.norm();
                   });
}

Metric time_metric(const SpinningBox& b) {
    return largest("time", "s", "how far the motion is ahead or behind at most",
                   [b](const World& w) { return b.top.ahead(b.spin_of(w), w.time); });
}

std::vector<Metric> momentum_metrics(const SpinningBox& b) {
    const Vector3d start = b.inertia().cwiseProduct(b.spin);
    const auto turn = [=](const World& w) {
        const Vector3d now = b.momentum_of(w);
        return std::atan2(now.cross(start).norm(), now.dot(start));
    };
    const auto growth = [=](const World& w) { return b.momentum_of(w).norm() / start.norm() - 1; };
    const auto gain = [=](const World& w) {
        return b.momentum_of(w).dot(w.bodies.angular_velocity[0]) / start.dot(b.spin) - 1;
    };
    return {largest("direction", "rad", "largest turn of the angular momentum", turn),
            largest("momentum", "", "largest change of the size of the angular momentum", growth),
            largest("energy", "", "largest change of the energy", gain)};
}

/// A wheel that spins about a level axis, whose one end a ball joint holds. Let go in steady
/// precession it stays there: Ω = m g l / (I_s ω_s), exactly.
struct Flywheel {
    double mass = 2, about_axis = 0.04, across = 0.024;  ///< [kg], [kg m²]
    double length = 0.3, spin = 100;                     ///< [m], [rad/s]
    double round = mass * kGravity * length / (about_axis * spin);

    Vector3d position(double time) const {
        return length * Vector3d(std::cos(round * time), 0, -std::sin(round * time));
    }
};

}  // namespace

Subject free_top() {
    Subject s =
        begin_subject("free_top", "A box of three different moments of inertia spins in free space",
                      "the angular velocity by Jacobi's elliptic functions", 5);
    const SpinningBox b({1, 2, 3});
    s.scene = scene_of(std::move(s.scene), b);
    s.metrics = momentum_metrics(b);
    s.metrics.insert(s.metrics.begin(), spin_metric(b));
    s.tolerance = 5e-10;
    s.orders = {.substeps = 4, .step = 4};
    return s;
}

Subject dzhanibekov() {
    Subject s = begin_subject("dzhanibekov",
                              "A box that spins about its middle axis flips over, again and again",
                              "flips an interval of 2 K(k)/ν apart, by elliptic functions", 5);
    const SpinningBox b({0, 6, 0.3});
    s.scene = scene_of(std::move(s.scene), b);
    s.metrics = momentum_metrics(b);
    s.metrics.insert(s.metrics.begin(), {time_metric(b), spin_metric(b)});
    s.tolerance = 6e-10;
    s.orders = {.substeps = 4, .step = 4};
    return s;
}

Subject gyroscope() {
    Subject s = begin_subject("gyroscope", "A flywheel with a level axis goes round on its pivot",
                              "steady precession at m g l / (I ω)", 4);
    const Flywheel wheel;
    BodySpec body;
    body.mass = wheel.mass;
    body.inertia = Vector3d(wheel.about_axis, wheel.across, wheel.across);
    body.placement.position = wheel.position(0);
    body.velocity = {0, 0, -wheel.round * wheel.length};
    body.angular_velocity = {wheel.spin, wheel.round, 0};
    s.scene.bodies.push_back(body);
    add_joint(s.scene, JointKind::ball, 0, kNoIndex, Vector3d::Zero());
    s.metrics = {
        largest("position", "", "largest error of the position, of the axis's length",
                [wheel](const World& w) {
                    const Vector3d off = w.bodies.position[0] - wheel.position(w.time);
                    return off.norm() / wheel.length;
                }),
        largest("nod", "rad", "largest angle of the axis with the level", [wheel](const World& w) {
            return std::asin(w.bodies.position[0].y() / wheel.length);
        })};
    s.tolerance = 2e-3;
    s.orders = {.substeps = 1, .step = 1};
    return s;
}

}  // namespace plumb::study
