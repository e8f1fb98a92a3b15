// SPDX-License-Identifier: MIT
/// Feature keys: the same while the same features touch, unique within a pair.
#include "standing.h"

#include <algorithm>

namespace plumb::test {
namespace {

class Features : public EachPlugin {
protected:
    static std::vector<std::uint64_t> keys(const std::vector<Contact>& contacts) {
        std::vector<std::uint64_t> all;
        for (const Contact& c : contacts) all.push_back(c.feature);
        return all;
    }

    /// Those kinds whose faces have corners: what a small step changes is no feature of theirs.
    static bool lasting(const Stack& stack) {
        const auto round = [](ShapeKind k) {
            return k == ShapeKind::cylinder || k == ShapeKind::cone;
        };
        // The edges of a face that is nearly level on a capsule are as deep as the face.
        const bool edges = stack.lower.shape.kind == ShapeKind::capsule &&
                           stack.upper.shape.kind == ShapeKind::mesh;
        return !edges && !round(stack.lower.shape.kind) && !round(stack.upper.shape.kind);
    }

    static bool of_parts(const Stack& stack) {
        return stack.lower.shape.kind == ShapeKind::compound ||
               stack.upper.shape.kind == ShapeKind::compound;
    }
};

TEST_P(Features, StayWhileABodySlidesAndTurnsALittle) {
    for (Stack stack : stacks(GetParam())) {
        if (!lasting(stack)) continue;
        SCOPED_TRACE(stack.name());
        // Turned off the axes, so that no corner lies above an edge.
        stack.upper.place.q = Q(Eigen::AngleAxisd(0.1, V::UnitY())) * stack.upper.place.q;
        stack.upper.place.x += V(.011, 0, .017);
        World world(GetParam());
        build(world, stack, -0.002);
        const std::vector<std::uint64_t> first = keys(world.detect(0.02));
        ASSERT_FALSE(first.empty());
        for (int i = 1; i <= 20; ++i) {
            // A part of a compound ends within the face that lies on it, and where that face tips
            // over the part's edge another feature touches: those turn about the upright only.
            const V axis = of_parts(stack) ? V::UnitY() : V(1, .3 * i, 2).normalized();
            const Q turn(Eigen::AngleAxisd(1e-4 * std::sin(i), axis));
            Place at = stack.upper.place;
            at.x += V(2e-4 * i, -0.002 + 1e-4 * std::cos(i), 1e-4 * i);
            at.q = turn * at.q;
            world.move(2, at);
            EXPECT_EQ(keys(world.detect(0.02)), first) << "after step " << i;
        }
    }
}

TEST_P(Features, AreUniqueWithinAPair) {
    for (const Stack& stack : stacks(GetParam())) {
        SCOPED_TRACE(stack.name());
        World world(GetParam());
        build(world, stack, -0.002);
        std::vector<std::uint64_t> all = keys(world.detect(0.02));
        std::sort(all.begin(), all.end());
        EXPECT_TRUE(std::adjacent_find(all.begin(), all.end()) == all.end());
    }
}

TEST_P(Features, TellOneFaceFromAnother) {
    PLUMB_NEEDS_CLAIM(ShapeKind::plane, ShapeKind::box, kPairManifold);
    World world(GetParam());
    world.add(0, plane(), {}, Mobility::fixed);
    world.add(1, box(.5, .5, .5), {V(0, .499, 0), Q::Identity()});
    const std::vector<std::uint64_t> one_face = keys(world.detect(0.01));
    world.move(1, {V(0, .499, 0), Q(Eigen::AngleAxisd(M_PI, V::UnitX()))});
    for (std::uint64_t key : keys(world.detect(0.01)))
        EXPECT_EQ(std::count(one_face.begin(), one_face.end(), key), 0)
            << "the opposite face lies on the plane, under the same key";
}

PLUMB_FOR_EACH_PLUGIN(Features);

}  // namespace
}  // namespace plumb::test
