// SPDX-License-Identifier: MIT
/// Chains that hang.
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/catenary.h"
#include "study/judges.h"
#include "ties/joint_state.h"

#include <algorithm>
#include <cmath>

namespace plumb::study {
namespace {

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
    constexpr int kLinks = 100;
    constexpr double kLink = 0.02, kSpan = 1;  // [m]
    const Catenary law(kLinks, kLink, kSpan);
    s.scene.settings.forbid = {"contacts"};
    std::vector<Vector3d> middles;
    for (std::uint32_t i = 0; i < kLinks; ++i) {
        const Vector3d half = 0.5 * kLink * law.along(i);
        middles.push_back(law.middle(i));
        add_body(s.scene, box(0.5 * kLink * Vector3d(1, 0.1, 0.1)), middles.back())
            .placement.rotation = axis_along(law.along(i));
        add_joint(s.scene, JointKind::hinge, i, i > 0 ? i - 1 : kNoIndex, middles.back() - half);
    }
    add_joint(s.scene, JointKind::hinge, kLinks - 1, kNoIndex, {kSpan, 0, 0});
    for (JointSpec& joint : s.scene.joints) joint.frame = axis_along(Vector3d::UnitZ());
    s.metrics = {largest("shape", "m", "largest distance of a rod from where it should hang",
                         [middles](const World& w) { return shape_error(middles, w); }),
                 last("force", "", "error of the force at a hook in the end",
                      [pull = law.pull()](const World& w) {
                          const double weight = w.bodies.mass[0] * kGravity;
                          return joint_load(w, 0).force.norm() / (weight * pull) - 1;
                      })};
    s.tolerance = 2.5e-5;  // what joints give way under load, whatever the step
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
