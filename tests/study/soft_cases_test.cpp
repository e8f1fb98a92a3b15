// SPDX-License-Identifier: MIT
/// What the cases of deformables say beyond their first metric and their own mesh.
#include "study/cases/list.h"
#include "study/measured.h"

#include <algorithm>

namespace plumb::test {
namespace {

double error_of(const study::Subject& subject, const std::string& metric) {
    const auto found = std::find_if(subject.metrics.begin(), subject.metrics.end(),
                                    [&](const study::Metric& m) { return m.name == metric; });
    const auto index = static_cast<std::size_t>(found - subject.metrics.begin());
    const double error = errors_of(subject, "reference").at(index);
    testing::Test::RecordProperty(metric, testing::PrintToString(error));
    return error;
}

TEST(Drape, IsTheSameOnFinerMeshes) {
    for (const std::uint32_t cells : {80u, 160u})
        EXPECT_LT(error_of(study::drape_of(cells, 120), "depth"), 0.02) << cells;
}

TEST(Cantilever, SwingsAtItsFrequency) {
    EXPECT_LT(error_of(study::cantilever(), "frequency"), 0.025);
}

/// Errors fall about as the square of a cell's size.
TEST(Cantilever, ComesToTheFormulaInSmallerCells) {
    const std::vector<double> coarse = errors_of(study::cantilever_of(2), "reference"),
                              fine = errors_of(study::cantilever_of(4), "reference");
    ASSERT_EQ(coarse.size(), 2u);
    for (std::size_t metric = 0; metric < 2; ++metric) {
        EXPECT_GT(fine[metric], 1e-3);
        EXPECT_LT(fine[metric], coarse[metric] / 3) << metric;
    }
}

TEST(PressedBalloon, GrowsAsMuchInLargerSubstepsOfMoreSweeps) {
    study::Subject subject = study::pressed_balloon();
    subject.scene.settings.substeps = 10, subject.scene.settings.position_iterations = 40;
    EXPECT_LT(error_of(subject, "growth"), subject.tolerance);
}

/// Twice as many sweeps take the strip to a tenth of a percent.
TEST(HangingStrip, ComesToTheFormulaByMoreSweeps) {
    study::Subject subject = study::hanging_strip();
    subject.scene.settings.substeps = 120;
    EXPECT_LT(error_of(subject, "elongation"), 1.5e-3);
}

/// Patch by patch a few iterations are enough.
TEST(PatchByPatch, CasesConvergeAt20SubstepsOfOneIteration) {
    const auto coarse = [](study::Subject subject) {
        subject.scene.settings.multilevel = true, subject.scene.settings.substeps = 20;
        subject.scene.settings.velocity_iterations = 1;
        subject.scene.settings.position_iterations = 1;
        return subject;
    };
    EXPECT_LT(error_of(coarse(study::hanging_strip()), "elongation"), 0.05);
    for (const std::uint32_t cells : {40u, 80u, 160u})
        EXPECT_LT(error_of(coarse(study::drape_of(cells, 20)), "depth"), 0.025) << cells;
    EXPECT_LT(error_of(coarse(study::rope_catenary()), "shape"), 5e-5);
    EXPECT_LT(error_of(coarse(study::hanging_rope()), "frequency"), 1e-3);
}

/// Errors of a hanging rope fall with its substeps.
TEST(RopeCatenary, ComesToItsPlaceBySubsteps) {
    study::Subject subject = study::rope_catenary();
    subject.scene.settings.substeps = 240;
    EXPECT_LT(error_of(subject, "shape"), 1e-4);
}

}  // namespace
}  // namespace plumb::test
