// SPDX-License-Identifier: MIT
/// Solids at large strains: how far a bar stretches under a force, and how thin it gets.
#include "support/random.h"
#include "support/scenes.h"
#include "support/soft.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumb::test {
namespace {

class Solids : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, Solids, each_precision(), precision_name);

/// A bar that is λ times as long and s times as wide stores, over its volume at rest,
/// ⅔ μ (λ − s)² + ½ K C², where C is Σ (w log s + (1 − w) (s − 1)) of its stretches.
struct PulledBar {
    double young, nu;  ///< E [Pa], ν

    double shear() const { return young / (2 * (1 + nu)); }
    double bulk() const { return young / (3 * (1 - 2 * nu)); }
    double share() const { return std::max(0.0, 3 * nu / (1 + nu)); }

    double pressure(double length, double width) const {
        const double w = share();
        return bulk() * (w * std::log(length * width * width) + (1 - w) * (length + 2 * width - 3));
    }
    double slope(double stretch) const { return share() / stretch + 1 - share(); }
    /// Where nothing pulls across.
    double width(double length) const {
        double low = 0.1, high = 2 * length;
        for (int i = 0; i < 60; ++i) {
            const double s = 0.5 * (low + high);
            const double pull = pressure(length, s) * slope(s) - 2 * shear() / 3 * (length - s);
            (pull < 0 ? low : high) = s;
        }
        return 0.5 * (low + high);
    }
    /// Force over the area at rest [Pa].
    double stress(double length) const {
        const double s = width(length);
        return 4 * shear() / 3 * (length - s) + pressure(length, s) * slope(length);
    }
};

constexpr std::array<std::uint32_t, 3> kBarCells{14, 3, 3};
constexpr double kBarLength = 1.4, kBarWidth = 0.3;  // [m]

/// A bar that hangs on the world by one end, and that a force pulls at the other.
Scene pulled(const PulledBar& law, double length) {
    Scene s;
    s.settings.gravity.setZero();
    s.settings.forbid = {"contacts"};
    s.settings.exact_deformables = 1000;
    DeformableSpec bar = block({kBarLength / 2, kBarWidth / 2, kBarWidth / 2}, kBarCells);
    bar.mass = 1;
    bar.elasticity.youngs_modulus = law.young, bar.elasticity.poissons_ratio = law.nu;
    bar.elasticity.damping = 0.3;
    std::vector<std::uint32_t> ends[2];
    for (std::uint32_t i = 0; i < bar.points.size(); ++i)
        if (std::abs(bar.points[i].x()) > 0.499 * kBarLength)
            ends[bar.points[i].x() > 0].push_back(i);
    add_soft(s, std::move(bar));
    BodySpec& end = add_body(s, box(0.01, kBarWidth, kBarWidth), {kBarLength / 2, 0, 0});
    end.mass = 1;
    end.force = {law.stress(length) * kBarWidth * kBarWidth, 0, 0};
    hold(s, 0, ends[0]);
    hold(s, 0, ends[1], 0);
    return s;
}

/// Mean of `value(point)` over the points of the bar that were at x at rest.
template <class Value>
double mean_at(const World& world, double x, Value value) {
    double sum = 0;
    int count = 0;
    const std::vector<Eigen::Vector3d>& rest = world.deformables[0].spec.points;
    for (std::size_t i = 0; i < rest.size(); ++i)
        if (std::abs(rest[i].x() - x) < 1e-6) sum += value(world.particles.position[i]), ++count;
    return sum / count;
}

TEST_P(Solids, ABarThatIsPulledKeepsItsVolumeAsItsPoissonsRatioSays) {
    Random random(17);
    for (int draw = 0; draw < 6; ++draw) {
        const double young = std::pow(10, random.number(4, 6)),
                     nu = draw % 2 == 0 ? random.number(0.45, 0.49) : random.number(-0.3, 0.45),
                     length = random.number(1.1, 2.4);
        const PulledBar law{young, nu};
        Scene s = pulled(law, length);
        s.settings.precision = GetParam();
        s.settings.dt = random.number(0.01, 0.03);
        Simulation simulation(s, colliders(), "reference");
        for (int i = 0; i < 250; ++i) ASSERT_TRUE(simulation.step().finite);
        const World& world = simulation.world();
        // layers about the middle, and how wide they are: of ± 1 and ± ⅓, the mean square is 5/9
        const double step = kBarLength / kBarCells[0];
        const auto along = [](const Eigen::Vector3d& p) { return p.x(); };
        const double stretched =
            (mean_at(world, step, along) - mean_at(world, -step, along)) / (2 * step);
        double width = 0;
        for (const double x : {-step, 0.0, step})
            width += 2 / 3.0 / kBarWidth *
                     std::sqrt(
                         mean_at(world, x, [](const Eigen::Vector3d& p) { return p.y() * p.y(); }) /
                         (5.0 / 9));
        std::cout << "draw " << draw << " nu " << nu << " stretched " << stretched << " of "
                  << length << ", width " << width << " of " << law.width(length) << "\n";
        EXPECT_NEAR(stretched / length, 1, 0.01);
        EXPECT_NEAR(width / law.width(length), 1, 0.01);
    }
}

}  // namespace
}  // namespace plumb::test
