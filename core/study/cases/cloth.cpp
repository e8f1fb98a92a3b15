// SPDX-License-Identifier: MIT
/// Cloth that hangs, and cloth that drapes.
#include "measure/deformation.h"
#include "reader/build_deformables.h"
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/elastic_laws.h"
#include "study/judges.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace plumb::study {
namespace {

/// How far off the lowest place of the first deformable's centre of mass is, over its depth.
class LowestCentre : public Judge {
public:
    explicit LowestCentre(double exact) : exact_(exact) {}

    void look(const World& w) override {
        lowest_ = std::min(lowest_, centre_of(w, w.deformables[0]).y());
    }
    double error() const override { return size_of(lowest_ / exact_ - 1); }

private:
    double exact_, lowest_ = 0;
};

}  // namespace

Subject hanging_strip() {
    Subject s = begin_subject("hanging_strip", "A strip of cloth of 20 rows hangs and stretches",
                              "Hooke's law, in Green's strain", 0.5);
    // swept, a strip of n rows takes about 5 n² sweeps in 10 ms
    s.scene.settings.substeps = 60;
    s.scene.settings.velocity_iterations = s.scene.settings.position_iterations = 42;
    constexpr std::uint32_t kRows = 20;
    constexpr double kLength = 1, kWidth = 0.2, kMass = 0.3, kStrain = 0.01;  // [m], [kg]
    DeformableSpec& strip = reader::add_soft(s.scene, reader::sheet({2, kRows}, {kWidth, kLength}));
    for (Vector3d& p : strip.points) p = {p.x(), p.z(), 0};
    strip.mass = kMass;
    strip.elasticity.youngs_modulus = kMass * kGravity / (2 * kStrain * kWidth * strip.thickness);
    strip.elasticity.poissons_ratio = strip.elasticity.bending_stiffness.emplace(0);
    strip.elasticity.damping = 0.05;
    constexpr std::uint32_t kTop = 3 * kRows + 1, kLowest = 1;
    reader::hold(s.scene, 0, {kTop - 1, kTop, kTop + 1});
    const double law = kLength * hanging_elongation(kRows, kStrain);
    s.metrics = {
        last("elongation", "", "error of the elongation in the end", [law](const World& w) {
            const std::vector<Vector3d>& p = w.particles.position;
            return ((p[kTop] - p[kLowest]).norm() - kLength) / law - 1;
        })};
    s.tolerance = 0.01;
    return s;
}

/// Until it swings back: its folds do not meet until then.
Subject drape_of(std::uint32_t cells, std::uint32_t substeps) {
    Subject s = begin_subject("drape", "A square cloth falls over a ball, and drapes it",
                              "a run of 161² particles at 480 substeps", 0.45);
    constexpr double kEdge = 1, kRadius = 0.25;     // [m]
    const double lowest = -0.2404, unknown = 5e-4;  // of the cloth's centre [m]
    s.scene.settings.substeps = substeps;
    s.scene.settings.forbid = {"surface_contacts"};
    s.scene.materials[0].friction = 0.3;
    add_body(s.scene, sphere(kRadius), {0, -kRadius, 0}, Motion::fixed);
    DeformableSpec& cloth =
        reader::add_soft(s.scene, reader::sheet({cells, cells}, {kEdge, kEdge}, {0, 0.005, 0}));
    cloth.mass = 0.3, cloth.radius = 0.005;
    cloth.elasticity.youngs_modulus = 2e5, cloth.elasticity.poissons_ratio = 0.3;
    cloth.elasticity.bending_stiffness = 1e-3;
    s.metrics = {{"depth", "", "error of the lowest mean height of the cloth",
                  [lowest] { return std::make_unique<LowestCentre>(lowest); }, unknown / -lowest}};
    s.tolerance = 0.02;
    return s;
}

/// In its substeps a wave crosses less than a cell.
Subject drape() { return drape_of(40, 60); }

}  // namespace plumb::study
