// SPDX-License-Identifier: MIT
/// A program's own terminate handler: in its place whenever no call of a collider is under way, and
/// called after ours when such a call ends in std::terminate.
#include "host/collider_call.h"
#include "support/scenes.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace plumb::test {
namespace {

void own_handler() { std::_Exit(77); }

void run_on(const std::string& collider) {
    const ColliderLibrary library(PLUMB_TEST_BAD_PLUGINS ":" PLUMB_TEST_PLUGINS);
    Simulation simulation(ball_on_ground(), library, collider);
    for (int i = 0; i < 25; ++i) simulation.step();
}

TEST(ColliderCall, LeavesTheProgramsHandlerInItsPlace) {
    const std::terminate_handler before = std::set_terminate(own_handler);
    run_on("ode");
    EXPECT_EQ(std::get_terminate(), own_handler);
    {
        const ColliderCall outer("a", "detect");
        EXPECT_NE(std::get_terminate(), own_handler);
        { const ColliderCall inner("b", "detect"); }
        EXPECT_NE(std::get_terminate(), own_handler) << "the outer call is still under way";
    }
    EXPECT_EQ(std::set_terminate(before), own_handler);
}

TEST(ColliderCall, KeepsAHandlerThatWasSetMeanwhile) {
    const std::terminate_handler before = std::get_terminate();
    {
        const ColliderCall call("a", "detect");
        std::set_terminate(own_handler);
    }
    EXPECT_EQ(std::set_terminate(before), own_handler);
}

TEST(ColliderCallDeathTest, SaysWhoItWasAndGoesOnToTheProgramsHandler) {
    for (const char* name : {"throws", "throws_on_a_thread"})
        EXPECT_EXIT(
            {
                std::set_terminate(own_handler);
                run_on(name);
            },
            ::testing::ExitedWithCode(77),
            "collider \"" + std::string(name) + "\" let an exception out of detect");
}

TEST(ColliderCallDeathTest, DoesWhatTheProgramAskedFor) {
    EXPECT_EXIT(
        {
            set_collider_end([](const std::string& sentence) {
                std::fprintf(stderr, "asked for: %s", sentence.c_str());
                std::_Exit(78);
            });
            run_on("throws");
        },
        ::testing::ExitedWithCode(78),
        "asked for: collider \"throws\" .*the tree has lost its root");
}

TEST(ColliderCallDeathTest, HasNothingToDoWithOtherExceptions) {
    EXPECT_EXIT(
        {
            run_on("ode");
            std::set_terminate(own_handler);
            std::terminate();
        },
        ::testing::ExitedWithCode(77), "^$");
}

}  // namespace
}  // namespace plumb::test
