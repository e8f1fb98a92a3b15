// SPDX-License-Identifier: MIT
/// Beams of tetrahedra.
#include "reader/build_deformables.h"
#include "study/cases/list.h"
#include "study/cases/parts.h"
#include "study/elastic_laws.h"
#include "study/judges.h"

#include <array>
#include <vector>

namespace plumb::study {

/// Let go straight, it swings about where it would rest. Tetrahedra of constant strain are too
/// stiff: four cells across, each 2.4 times as high as long, by 4 % in a body-centred lattice and
/// by 7 % in one of five a cell; of a Poisson's ratio of 0.3 by three more.
Subject cantilever_of(std::uint32_t across) {
    Subject s =
        begin_subject("cantilever", "A beam of tetrahedra, four across, bends under its own weight",
                      "q L⁴/8EI and (1.8751²/2π) √(EI/ρAL⁴), with Timoshenko's shear", 0);
    constexpr double kWeak = 1;  // gravity [m/s²]
    const std::array<std::uint32_t, 3> cells{12 * across, across, across};
    Cantilever law;
    law.length = 2, law.height = law.width = 0.4;
    law.young = 5e6, law.nu = 0, law.density = 1000;
    s.scene.settings.substeps = 50 * across;  // a wave crosses a sixth of half a cell in one
    s.scene.settings.gravity = {0, -kWeak, 0};
    DeformableSpec& beam = reader::add_soft(
        s.scene, reader::block({law.length / 2, law.height / 2, law.width / 2}, cells,
                               {law.length / 2, 0, 0}, reader::CellCut::body_centered));
    s.scene.materials[0].density = law.density;
    beam.elasticity.youngs_modulus = law.young, beam.elasticity.poissons_ratio = law.nu;
    std::vector<std::uint32_t> wall, tip;
    for (std::uint32_t i = 0; i < beam.points.size(); ++i) {
        if (beam.points[i].x() < 1e-9) wall.push_back(i);
        if (beam.points[i].x() > law.length - 1e-9) tip.push_back(i);
    }
    reader::hold(s.scene, 0, wall);

    const double deflection = law.deflection(kWeak), frequency = law.frequency();
    const auto too_low = [=](const World& w) {
        double sum = 0;
        for (const std::uint32_t i : tip) sum -= w.particles.position[i].y();
        return sum / static_cast<double>(tip.size()) / deflection - 1;
    };
    s.scene.settings.duration = 1.4 / frequency;  // it passes upwards after 1/4 and 5/4 swings
    s.metrics = {of_mean("deflection", "", "error of the tip's mean deflection", too_low),
                 frequency_metric("error of the first frequency", too_low, frequency)};
    s.tolerance = 0.05;
    return s;
}

Subject cantilever() { return cantilever_of(4); }

}  // namespace plumb::study
