// SPDX-License-Identifier: MIT
/// Errors of the cases fall as fast as the cases say: slopes of log error against log step, fitted
/// over half, once, twice and four times the resolution, in double precision.
#include "study/measured.h"

#include <iostream>
#include <ostream>
#include <utility>

namespace plumb::test {
namespace {

constexpr double kRounding = 1.5e-11;  ///< errors below it are not of the steps' making

/// Slope of the straight line that fits the points best.
double slope_of(const std::vector<std::pair<double, double>>& points) {
    const double n = static_cast<double>(points.size());
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [a, b] : points) x += a, y += b, xx += a * a, xy += a * b;
    return (n * xy - x * y) / (n * xx - x * x);
}

/// Order at which the first metric falls; `refine` makes the steps finer by a factor, and says
/// whether it could.
double order_of(const study::CaseEntry& entry, bool (*refine)(Settings&, double),
                bool leapfrog = false) {
    std::vector<std::pair<double, double>> points;
    for (const double finer : {0.5, 1.0, 2.0, 4.0}) {
        study::Subject subject = entry.make();
        subject.scene.settings.precision = Precision::double_;
        subject.scene.settings.leapfrog_start = leapfrog;
        if (!refine(subject.scene.settings, finer)) continue;
        const double error = errors_of(subject)[0];
        std::cout << "  " << error;
        if (error > kRounding) points.emplace_back(std::log(finer), std::log(error));
    }
    const double order = -slope_of(points);
    std::cout << ": order " << order << "\n";
    return order;
}

bool refine_substeps(Settings& s, double finer) {
    const double substeps = s.substeps * finer;
    s.substeps = static_cast<std::uint32_t>(substeps);
    return s.substeps == substeps;
}

bool refine_step(Settings& s, double finer) {
    s.dt /= finer;
    return true;
}

/// What a case says of one way of refining.
struct Stated {
    study::CaseEntry entry;
    const char* way;
    double order;
    bool (*refine)(Settings&, double);
};

void PrintTo(const Stated& stated, std::ostream* out) { *out << stated.entry.name; }

std::vector<Stated> stated_orders() {
    std::vector<Stated> all;
    for (const study::CaseEntry& entry : study::cases()) {
        const study::Orders orders = entry.make().orders;
        if (orders.substeps > 0)
            all.push_back({entry, "substeps", orders.substeps, refine_substeps});
        if (orders.step > 0) all.push_back({entry, "step", orders.step, refine_step});
    }
    return all;
}

class Order : public testing::TestWithParam<Stated> {};
INSTANTIATE_TEST_SUITE_P(, Order, testing::ValuesIn(stated_orders()), [](const auto& which) {
    return std::string(which.param.entry.name) + "_by_" + which.param.way;
});

TEST_P(Order, IsAsStated) {
    EXPECT_NEAR(order_of(GetParam().entry, GetParam().refine), GetParam().order, 0.15);
}

/// Half of the first push makes what swings second order, and constant forces exact.
class LeapfrogOrder : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, LeapfrogOrder,
                         testing::Values("pendulum", "double_pendulum", "gyroscope"),
                         [](const auto& which) { return std::string(which.param); });

TEST_P(LeapfrogOrder, IsTwo) {
    EXPECT_NEAR(order_of(*study::find_case(GetParam()), refine_substeps, true), 2, 0.15);
}

/// Springs are taken to fourth order (constraints/spring.h).
TEST(LeapfrogStart, TakesSpringsToFourthOrder) {
    EXPECT_NEAR(order_of(*study::find_case("springs"), refine_substeps, true), 4, 0.15);
}

/// What README says of the pendulum at 64 substeps.
TEST(LeapfrogStart, MakesThePendulumExactToMicroradians) {
    for (const bool leapfrog : {false, true}) {
        study::Subject subject = study::find_case("pendulum")->make();
        subject.scene.settings.leapfrog_start = leapfrog;
        subject.scene.settings.substeps = 64;
        const double error = errors_of(subject)[0];
        EXPECT_NEAR(error, leapfrog ? 2.1e-6 : 7.1e-4, 0.1 * error);
    }
}

TEST(LeapfrogStart, IsExactUnderConstantForces) {
    for (const char* name : {"parabola", "rolling_down"})
        for (const std::uint32_t substeps : {1u, 3u, 20u}) {
            study::Subject subject = study::find_case(name)->make();
            subject.scene.settings.precision = Precision::double_;
            subject.scene.settings.leapfrog_start = true;
            subject.scene.settings.substeps = substeps;
            EXPECT_LT(errors_of(subject)[0], 1e-10) << name << ", " << substeps << " substeps";
        }
}

}  // namespace
}  // namespace plumb::test
