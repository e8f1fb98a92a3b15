// SPDX-License-Identifier: MIT
/// Chains that hang.
#include "step/joint_state.h"
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/judges.h"

#include <algorithm>
#include <cmath>

namespace plumb::study {
namespace {

/// A chain of N rods of length l between two hooks of one height :
/// the i-th rod climbs by tan θᵢ = (i − (N − 1)/2) w/H, w a rod's weight, H the level part of the
/// force, which the span gives.
struct Catenary {
    static constexpr int kLinks = 100;
    double link = 0.02, span = 1;  ///< [m]
    double share = found_share();  ///< w/H

    double tangent(int i, double of) const { return (i - 0.5 * (kLinks - 1)) * of; }
    Vector3d along(int i) const {
        const double slope = tangent(i, share), level = 1 / std::sqrt(1 + slope * slope);
        return {level, slope * level, 0};
    }
    /// Middle of a rod; the first hook is at the origin [m].
    Vector3d middle(int i) const {
        Vector3d sum = 0.5 * link * along(i);
        for (int k = 0; k < i; ++k) sum += link * along(k);
        return sum;
    }
    /// Force at a hook over a rod's weight.
    double pull() const { return std::hypot(0.5 * kLinks, 1 / share); }

private:
    double spanned(double of) const {
        double sum = 0;
        for (int i = 0; i < kLinks; ++i) sum += link / std::hypot(1, tangent(i, of));
        return sum;
    }
    /// By bisection.
    double found_share() const {
        double low = 0, high = 10;
        for (int i = 0; i < 100; ++i) {
            const double middle = 0.5 * (low + high);
            (spanned(middle) > span ? low : high) = middle;
        }
        return low;
    }
};

double shape_error(const std::vector<Vector3d>& exact, const World& w) {
    double worst = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
        worst = std::max(worst, size_of((w.bodies.position[i] - exact[i]).norm()));
    return worst;
}

/// Balls of 1 kg on rods of 0.1 m below each other, the last of `ratio` times the mass.
void add_weights(Scene& scene, std::uint32_t count, double ratio) {
    constexpr double kRod = 0.1;
    scene.settings.forbid = {"contacts"};
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector3d hook(0, -kRod * i, 0), ball(0, -kRod * (i + 1), 0);
        add_body(scene, sphere(0.02), ball).mass = i + 1 < count ? 1 : ratio;
        add_joint(scene, JointKind::distance, i, i > 0 ? i - 1 : kNoIndex, ball).anchor_b = hook;
    }
}

Metric stretch_metric(const Scene& scene) {
    const double length = -scene.bodies.back().placement.position.y();
    return largest("stretch", "", "largest stretch, of the length",
                   [length](const World& w) { return -w.bodies.position.back().y() / length - 1; });
}

Metric force_metric(const Scene& scene) {
    double weight = 0;
    for (const BodySpec& body : scene.bodies) weight += *body.mass * kGravity;
    return last("force", "", "error of the force at the top in the end",
                [weight](const World& w) { return joint_load(w, 0).force.y() / weight - 1; });
}

}  // namespace

Subject catenary() {
    Subject s = begin_subject("catenary", "A chain of 100 rods hangs between two hooks",
                              "tan θᵢ = (i − (N − 1)/2) w/H", 1);
    const Catenary law;
    s.scene.settings.forbid = {"contacts"};
    std::vector<Vector3d> middles;
    for (std::uint32_t i = 0; i < Catenary::kLinks; ++i) {
        const Vector3d half = 0.5 * law.link * law.along(i);
        middles.push_back(law.middle(i));
        add_body(s.scene, box(0.5 * law.link * Vector3d(1, 0.1, 0.1)), middles.back())
            .placement.rotation = axis_along(law.along(i));
        add_joint(s.scene, JointKind::hinge, i, i > 0 ? i - 1 : kNoIndex, middles.back() - half);
    }
    add_joint(s.scene, JointKind::hinge, Catenary::kLinks - 1, kNoIndex, {law.span, 0, 0});
    for (JointSpec& joint : s.scene.joints) joint.frame = axis_along(Vector3d::UnitZ());
    s.metrics = {largest("shape", "m", "largest distance of a rod from where it should hang",
                         [middles](const World& w) { return shape_error(middles, w); }),
                 last("force", "", "error of the force at a hook in the end",
                      [pull = law.pull()](const World& w) {
                          const double weight = w.bodies.mass[0] * kGravity;
                          return joint_load(w, 0).force.norm() / (weight * pull) - 1;
                      })};
    s.tolerance = 2.5e-4;
    s.orders = {.step = 2};  // as a share of g dt²
    return s;
}

Subject hanging_chain() {
    Subject s = begin_subject("hanging_chain", "Twenty balls on rods, the last 1000 times as heavy",
                              "the rods keep their length, and the top bears all of the weight", 2);
    add_weights(s.scene, 20, 1000);
    s.metrics = {force_metric(s.scene), stretch_metric(s.scene)};
    s.tolerance = 1e-7;
    return s;
}

Subject heavy_chain() {
    Subject s = begin_subject("heavy_chain", "A hundred balls on rods, solved by iterations",
                              "the rods keep their length", 2);
    add_weights(s.scene, 100, 1);
    s.scene.settings.joints = JointMethod::iterate;
    s.metrics = {stretch_metric(s.scene)};
    s.tolerance = 0.01;
    s.orders = {.substeps = 2};
    return s;
}

}  // namespace plumb::study
