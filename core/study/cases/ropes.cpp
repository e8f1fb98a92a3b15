// SPDX-License-Identifier: MIT
/// Ropes of particles that hang.
#include "reader/build_deformables.h"
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/catenary.h"
#include "study/judges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace plumb::study {
namespace {

/// Segments of a rope that knows no bending.
struct RopeParts {
    int segments = 40;
    double length = 2, mass = 1;  ///< of all [m], [kg]
    double softness = 2.5e-5;     ///< strain of a segment that bears the weight of one

    double segment() const { return length / segments; }
    double weight() const { return mass * kGravity / segments; }
};

/// So many that a wave crosses less than a segment in one: then a sweep or two solve it.
constexpr std::uint32_t kSubsteps = 60;

/// Adds a rope whose first point is at the origin.
template <class Along>
void add_rope(Scene& scene, const RopeParts& r, Along along) {
    DeformableSpec& rope = reader::add_soft(
        scene, reader::rope(Vector3d::Zero(), {r.length, 0, 0}, std::uint32_t(r.segments)));
    for (int i = 0; i < r.segments; ++i)
        rope.points[i + 1] = rope.points[i] + r.segment() * along(i);
    rope.mass = r.mass;
    rope.thickness = 0.01;
    const double section = rope.thickness * rope.thickness * std::numbers::pi / 4;
    rope.elasticity.youngs_modulus = r.weight() / (r.softness * section);
    rope.elasticity.bending_stiffness = 0;
}

/// Distance of the particle that is, in the mean over time, farthest from its place.
class MeanShape : public Judge {
public:
    explicit MeanShape(std::vector<Vector3d> places) : places_(std::move(places)) {}

    void look(const World& w) override {
        if (w.steps == 0) return;
        sums_.resize(places_.size(), Vector3d::Zero());
        for (std::size_t i = 0; i < sums_.size(); ++i)
            sums_[i] += w.particles.position[i] - places_[i];
        ++count_;
    }
    double error() const override {
        double worst = 0;
        for (const Vector3d& sum : sums_) worst = std::max(worst, size_of(sum.norm() / count_));
        return worst;
    }

private:
    std::vector<Vector3d> places_, sums_;
    double count_ = 0;
};

}  // namespace

Subject rope_catenary() {
    Subject s = begin_subject("rope_catenary", "A rope of 40 segments hangs between two hooks",
                              "tan θᵢ = (i − (N − 1)/2) w/H, and Hooke's law", 2);
    s.scene.settings.substeps = kSubsteps;
    const RopeParts rope;
    constexpr double kSpan = 1;  // [m]
    const Catenary start(rope.segments, rope.segment(), kSpan),
        law(rope.segments, rope.segment(), kSpan, rope.softness);
    add_rope(s.scene, rope, [&](int i) { return start.along(i); });
    reader::hold(s.scene, 0, {0, std::uint32_t(rope.segments)});
    std::vector<Vector3d> places;
    for (int i = 0; i <= rope.segments; ++i) places.push_back(law.begin(i));
    s.metrics = {{"shape", "m", "largest distance of a particle's mean place from its own",
                  [places] { return std::make_unique<MeanShape>(places); }}};
    s.tolerance = 5e-4;
    return s;
}

/// Small swings of a rope that hangs from one end: y = A J₀(2 ω √(x/g)) cos ω t, x [m] above the
/// free end, where 2 ω √(L/g) is the first zero of J₀ (Daniel Bernoulli, 1733).
Subject hanging_rope() {
    Subject s = begin_subject("hanging_rope", "A rope hangs from one end and swings a little",
                              "the first zero of Bessel's function J₀", 6);
    constexpr double kZero = 2.404825557695773, kTip = 0.02;  // kTip: of the length
    s.scene.settings.substeps = kSubsteps;
    const RopeParts rope;
    const double rate = kZero / 2 * std::sqrt(kGravity / rope.length);
    add_rope(s.scene, rope, [&](int i) -> Vector3d {
        const double root = std::sqrt((rope.segments - i - 0.5) / rope.segments);
        const double slope = kTip * kZero / (2 * root) * std::cyl_bessel_j(1, kZero * root);
        return Vector3d(slope, -1, 0).normalized();
    });
    reader::hold(s.scene, 0, {0});
    s.metrics = {frequency_metric(
        "error of the frequency", [](const World& w) { return w.particles.position.back().x(); },
        rate / (2 * std::numbers::pi))};
    s.tolerance = 1e-3;
    return s;
}

}  // namespace plumb::study
