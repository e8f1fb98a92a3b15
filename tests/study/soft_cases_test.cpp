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
        EXPECT_LT(error_of(study::drape_of(cells, 40), "depth"), 0.02) << cells;
}

TEST(Cantilever, SwingsAtItsFrequency) {
    EXPECT_LT(error_of(study::cantilever(), "frequency"), 0.025);
}

TEST(PressedBalloon, GrowsAsMuchInLargerSubstepsOfMoreSweeps) {
    study::Subject subject = study::pressed_balloon();
    subject.scene.settings.substeps = 10, subject.scene.settings.position_iterations = 40;
    EXPECT_LT(error_of(subject, "growth"), subject.tolerance);
}

TEST(HangingStrip, ComesToTheFormulaInAnySubsteps) {
    study::Subject subject = study::hanging_strip();
    for (const std::uint32_t substeps : {2u, 5u, 20u}) {
        subject.scene.settings.substeps = substeps;
        EXPECT_LT(error_of(subject, "elongation"), 2e-3) << substeps;
    }
}

/// Errors of a hanging rope fall with its substeps.
TEST(RopeCatenary, ComesToItsPlaceBySubsteps) {
    study::Subject subject = study::rope_catenary();
    subject.scene.settings.substeps = 20;
    EXPECT_LT(error_of(subject, "shape"), 1e-4);
}

}  // namespace
}  // namespace plumb::test
