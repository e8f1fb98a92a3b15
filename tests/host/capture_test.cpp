// SPDX-License-Identifier: MIT
/// The residual of a frame, and of a recording made of frames, is what the step reported.
#include "output/recording.h"
#include "output/temporary_folder.h"
#include "support/scenes.h"

#include <cmath>

namespace plumb::test {
namespace {

/// Boxes that fall a little and then stand on each other, iterated too little to be solved.
Scene swept_tower() {
    Scene s;
    add_ground(s);
    for (int i = 0; i < 4; ++i) add_body(s, box(0.2, 0.2, 0.2), {0.02 * i, 0.22 + 0.42 * i, 0});
    s.settings.velocity_iterations = s.settings.position_iterations = 1;
    s.settings.exact_islands = 0, s.settings.accuracy = 0;
    return s;
}

bool is_untold(const FrameResidual& r) {
    return std::isnan(r.force_of_weight) && std::isnan(r.force) && std::isnan(r.error);
}

TEST(CapturedFrame, HasTheResidualOfTheLastStep) {
    Simulation simulation(swept_tower(), colliders(), "reference");
    Frame frame;
    simulation.capture(frame);
    EXPECT_TRUE(is_untold(frame.residual)) << "no step was made";
    const std::string start = simulation.save();
    double most = 0;
    for (int i = 0; i < 30; ++i) {
        const StepResidual residual = simulation.step().residual;
        simulation.capture(frame);
        EXPECT_EQ(frame.residual.force_of_weight, residual.worst.force_of_weight());
        EXPECT_EQ(frame.residual.force, residual.force);
        EXPECT_EQ(frame.residual.error, residual.error);
        most = std::max(most, frame.residual.force_of_weight);
    }
    EXPECT_GT(most, 0.01);
    simulation.restore(start);
    simulation.capture(frame);
    EXPECT_TRUE(is_untold(frame.residual)) << "a saved state does not tell";
}

class RecordedRun : public TemporaryFolder {};

TEST_F(RecordedRun, HasTheResidualsOfItsSteps) {
    const Scene scene = swept_tower();
    Simulation simulation(scene, colliders(), "reference");
    RecordingWriter writer(path("run.plumb"), scene, {});
    std::vector<StepResidual> told;
    Frame frame;
    for (int i = 0; i < 40; ++i) {
        told.push_back(simulation.step().residual);
        simulation.capture(frame);
        if (i == 20) frame.residual = {};  // a program may keep it to itself
        writer.append(frame);
    }
    writer.close();

    const Recording recording = read_recording(path("run.plumb"));
    EXPECT_TRUE(recording.header.residuals);
    ASSERT_EQ(recording.frames.size(), told.size());
    const auto as_float = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    int unsolved = 0;
    for (std::size_t i = 0; i < told.size(); ++i) {
        const FrameResidual& got = recording.frames[i].residual;
        if (i == 20) {
            EXPECT_TRUE(is_untold(got));
            continue;
        }
        EXPECT_EQ(got.force_of_weight, as_float(told[i].worst.force_of_weight())) << i;
        EXPECT_EQ(got.force, as_float(told[i].force)) << i;
        EXPECT_EQ(got.error, as_float(told[i].error)) << i;
        unsolved += got.force_of_weight > 0.001 && got.force > 0.001 && got.error > 0;
    }
    EXPECT_GT(unsolved, 20);
}

}  // namespace
}  // namespace plumb::test
