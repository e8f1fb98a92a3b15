// SPDX-License-Identifier: MIT
/// What the library logs, into a logger of the program's own.
#include "host/log.h"

#include "support/scenes.h"

#include <spdlog/sinks/ostream_sink.h>

#include <sstream>

namespace plumb::test {
namespace {

class Log : public testing::Test {
protected:
    Log() {
        auto own = std::make_shared<spdlog::logger>(
            "own", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_));
        own->set_pattern("%l: %v");
        own->set_level(spdlog::level::warn);
        set_logger(own);
        add_ground(scene_);
        add_body(scene_, box(0.5, 0.5, 0.5), {0, 0.5, 0});
        scene_.materials[0].friction = 0.5;
        scene_.settings.forbid = {"friction"};
    }
    ~Log() override { set_logger(nullptr); }

    Scene scene_;
    std::ostringstream text_;
};

TEST_F(Log, WarnsOnceOfWhatThePlanWarnsOf) {
    Simulation simulation(scene_, colliders(), "reference");
    const std::string said = text_.str();
    EXPECT_EQ(said.find("warning: \"friction\" is forbidden, but the scene calls for it"), 0u);
    EXPECT_EQ(simulation.plan().warnings.size(), 1u);
    simulation.step();
    BodySpec more;
    more.geometry = 1;
    more.placement.position = {0, 5, 0};
    simulation.add_body(more);
    simulation.step();
    EXPECT_EQ(text_.str(), said) << "an edit tells it again";
}

TEST_F(Log, ErrorsOnlyKeepsWarningsBackWhileItLives) {
    {
        const ErrorsOnly quiet;
        Simulation simulation(scene_, colliders(), "reference");
        EXPECT_EQ(text_.str(), "");
    }
    EXPECT_EQ(logger()->level(), spdlog::level::warn);
}

TEST_F(Log, DebugTellsOfStepsThatWentWrong) {
    logger()->set_level(spdlog::level::debug);
    scene_.settings.forbid = {};
    scene_.bodies[1].mass = 1e-6;
    scene_.bodies[1].force = {1e308, 0, 0};
    Simulation simulation(scene_, colliders(), "reference");
    while (simulation.step().finite && simulation.steps() < 10) continue;
    EXPECT_NE(text_.str().find("the state is no longer finite"), std::string::npos) << text_.str();
}

}  // namespace
}  // namespace plumb::test
