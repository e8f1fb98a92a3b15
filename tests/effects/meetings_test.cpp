// SPDX-License-Identifier: MIT
#include "effects/meetings.h"
#include "scene/build.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

Scene scene_of(const std::vector<BodySpec>& bodies) {
    Scene scene;
    add_geometry(scene, sphere(0.5));
    scene.bodies = bodies;
    return scene;
}
BodySpec ball(Motion motion, std::uint32_t group, std::uint32_t mask) {
    BodySpec body;
    body.geometry = 0;
    body.motion = motion;
    body.group = group, body.mask = mask;
    return body;
}
std::size_t meeting(const std::vector<BodySpec>& bodies) {
    return bodies_that_meet(build_world(scene_of(bodies)));
}

TEST(Meetings, NeedTwoBodiesOfWhichOneIsDynamic) {
    const BodySpec moving = ball(Motion::dynamic, 1, ~0u), fixed = ball(Motion::fixed, 1, ~0u);
    EXPECT_EQ(meeting({moving}), 0u);
    EXPECT_EQ(meeting({moving, moving}), 2u);
    EXPECT_EQ(meeting({moving, fixed}), 2u);
    EXPECT_EQ(meeting({fixed, fixed}), 0u);
}

TEST(Meetings, NeedFiltersThatAgreeBothWays) {
    const BodySpec red = ball(Motion::dynamic, 1, 2), blue = ball(Motion::dynamic, 2, 1),
                   deaf = ball(Motion::dynamic, 1, 0), loner = ball(Motion::dynamic, 2, 2);
    EXPECT_EQ(meeting({red, blue}), 2u);
    EXPECT_EQ(meeting({red, red, red}), 0u);
    EXPECT_EQ(meeting({deaf, deaf, blue}), 0u);
    EXPECT_EQ(meeting({red, loner}), 0u);
    EXPECT_EQ(meeting({loner, loner, red}), 2u);
}

}  // namespace
}  // namespace plumb
