// SPDX-License-Identifier: MIT
#include "effects/filter_reachability.h"
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
std::size_t collidable(const std::vector<BodySpec>& bodies) {
    return collidable_bodies(build_world(scene_of(bodies)));
}

TEST(FilterReachability, NeedsTwoBodiesOfWhichOneIsDynamic) {
    const BodySpec moving = ball(Motion::dynamic, 1, ~0u), fixed = ball(Motion::fixed, 1, ~0u);
    EXPECT_EQ(collidable({moving}), 0u);
    EXPECT_EQ(collidable({moving, moving}), 2u);
    EXPECT_EQ(collidable({moving, fixed}), 2u);
    EXPECT_EQ(collidable({fixed, fixed}), 0u);
}

TEST(FilterReachability, NeedsFiltersThatAgreeBothWays) {
    const BodySpec red = ball(Motion::dynamic, 1, 2), blue = ball(Motion::dynamic, 2, 1),
                   deaf = ball(Motion::dynamic, 1, 0), loner = ball(Motion::dynamic, 2, 2);
    EXPECT_EQ(collidable({red, blue}), 2u);
    EXPECT_EQ(collidable({red, red, red}), 0u);
    EXPECT_EQ(collidable({deaf, deaf, blue}), 0u);
    EXPECT_EQ(collidable({red, loner}), 0u);
    EXPECT_EQ(collidable({loner, loner, red}), 2u);
}

}  // namespace
}  // namespace plumb
