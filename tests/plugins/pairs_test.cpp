// SPDX-License-Identifier: MIT
/// Every pair of kinds that a plugin's table claims, one standing on the other: found, full,
/// separated, turned as a whole and numbered either way, each as claimed.
#include "standing.h"

#include <cstring>

namespace plumb::test {
namespace {

class Pairs : public EachPlugin {
protected:
    /// Gaps at which a stack must be found.
    static std::vector<double> gaps(const Stack& stack) {
        std::vector<double> all = {-0.0005, -0.005};
        if (stack.ability & kPairSeparated) all.insert(all.begin(), {0.005, 0.0});
        return all;
    }

    void meet(const Stack& stack, double gap, const Place& frame, std::uint32_t lower) {
        World world(GetParam());
        build(world, stack, gap, frame, lower);
        const auto& contacts = world.detect(kMargin);
        EXPECT_EQ(world.status().code, Status::ok);
        ASSERT_FALSE(contacts.empty()) << "the pair was missed";
        expect_sound(contacts, kMargin);
        const V up = frame.q * V::UnitY() * (lower == 1 ? -1.0 : 1.0);
        const Contact& d = deepest(contacts);
        EXPECT_NEAR(d.gap, gap, relative_accuracy(GetParam()));
        for (const Contact& c : contacts) EXPECT_GT(v(c.normal).dot(up), std::cos(.5 * M_PI / 180));
        if (stack.ability & kPairManifold) {
            EXPECT_GE(contacts.size(), static_cast<std::size_t>(stack.points()));
        }
    }
};

TEST_P(Pairs, EveryClaimedPairIsFound) {
    const Place home{}, away{V(3, -2, 5), Q(Eigen::AngleAxisd(1.3, V(1, 2, -3).normalized()))};
    for (const Stack& stack : stacks(GetParam())) {
        for (double gap : gaps(stack))
            for (const Place& frame : {home, away})
                for (std::uint32_t lower : {1u, 2u}) {
                    SCOPED_TRACE(stack.name() + " at gap " + std::to_string(gap) +
                                 (frame.x.norm() > 0 ? ", turned" : "") +
                                 (lower == 1 ? "" : ", swapped"));
                    meet(stack, gap, frame, lower);
                }
    }
}

TEST_P(Pairs, TheTableIsInOrder) {
    const PluginTable& t = plugin(GetParam());
    EXPECT_EQ(t.magic, kPluginMagic);
    EXPECT_EQ(t.abi_major, kAbiMajor);
    const AbiSizes sizes = abi_sizes();
    EXPECT_EQ(std::memcmp(&t.sizes, &sizes, sizeof sizes), 0) << "structs of other sizes";
    for (const char* text : {t.name, t.description, t.backend_version, t.precision})
        ASSERT_TRUE(text && *text) << "a name or description is missing";
    EXPECT_TRUE(!std::strcmp(t.precision, "double") || !std::strcmp(t.precision, "single"));
    EXPECT_EQ(t.pairs[0][0], kPairNone) << "two half-spaces never touch in points";
    for (std::uint32_t i = 0; i < kShapeKindCount; ++i)
        for (std::uint32_t j = 0; j < kShapeKindCount; ++j) {
            const std::uint32_t able = t.pairs[i][j];
            EXPECT_EQ(able, t.pairs[j][i]) << "the table of pairs is not symmetric";
            EXPECT_EQ(t.costs[i][j], t.costs[j][i]) << "the table of costs is not symmetric";
            EXPECT_TRUE(able == kPairNone || (able & (kPairPoint | kPairManifold)))
                << "claims, but finds what?";
        }
}

TEST_P(Pairs, NothingBeyondTheMargin) {
    for (const Stack& stack : stacks(GetParam()))
        for (double margin : {0.002, 0.01, 0.1}) {
            SCOPED_TRACE(stack.name() + " at margin " + std::to_string(margin));
            World world(GetParam());
            build(world, stack, margin + 2 * relative_accuracy(GetParam()));
            EXPECT_TRUE(world.detect(margin).empty()) << "margins are counted twice";
        }
}

TEST_P(Pairs, AllWithinTheMargin) {
    for (const Stack& stack : stacks(GetParam())) {
        if (!(stack.ability & kPairSeparated)) continue;
        for (double margin : {0.002, 0.01, 0.1}) {
            SCOPED_TRACE(stack.name() + " at margin " + std::to_string(margin));
            World world(GetParam());
            build(world, stack, margin - 2 * relative_accuracy(GetParam()));
            EXPECT_FALSE(world.detect(margin).empty());
            if (stack.ability & kPairManifold) {
                EXPECT_GE(world.last().size(), static_cast<std::size_t>(stack.points()));
            }
        }
    }
}

TEST_P(Pairs, SweepsOfBothWidenTheMargin) {
    for (const Stack& stack : stacks(GetParam())) {
        if (!(stack.ability & kPairSeparated)) continue;
        SCOPED_TRACE(stack.name());
        World world(GetParam());
        build(world, stack, 0.1);
        EXPECT_TRUE(world.detect(kMargin).empty());
        world.sweeps = {0, 0.04, 0.04};
        EXPECT_TRUE(world.detect(kMargin).empty()) << "0.01 + 0.04 + 0.04 is less than 0.1";
        world.sweeps = {0, 0.05, 0.045};
        ASSERT_FALSE(world.detect(kMargin).empty());
        EXPECT_NEAR(deepest(world.last()).gap, 0.1, 2 * relative_accuracy(GetParam()));
        world.sweeps = {0, 0.095, 0};
        EXPECT_FALSE(world.detect(kMargin).empty()) << "one of the two moves that far";
    }
}

TEST_P(Pairs, MovingSurfacesTakeTheirContactsAlong) {
    for (const Stack& stack : stacks(GetParam())) {
        // A half-space that is turned away may still hold what stood on it.
        if (!(stack.ability & kPairMovingMesh) || stack.lower.shape.kind == ShapeKind::plane)
            continue;
        SCOPED_TRACE(stack.name());
        World world(GetParam());
        Place upper = stack.upper.place;
        upper.x.y() -= 0.001;
        world.add(1, stack.lower.shape, stack.lower.place, Mobility::kinematic);
        world.add(2, stack.upper.shape, upper);
        ASSERT_FALSE(world.detect(kMargin).empty());
        const Place away{V(3, -2, 5), Q(Eigen::AngleAxisd(1.3, V(1, 2, -3).normalized()))};
        world.move(1, away * stack.lower.place);
        EXPECT_TRUE(world.detect(kMargin).empty()) << "the surface has gone";
        world.move(2, away * upper);
        ASSERT_FALSE(world.detect(kMargin).empty()) << "both have moved";
        const Contact& d = deepest(world.last());
        EXPECT_NEAR(d.gap, -0.001, relative_accuracy(GetParam()));
        EXPECT_LT(v(d.normal).dot(away.q * V::UnitY()), -0.99);
    }
}

TEST_P(Pairs, FaceContactsSpanTheirArea) {
    for (double shift : {0.0, 0.35})
        for (Stack stack : stacks(GetParam())) {
            const bool flat = !stack.lower.outline.empty() && !stack.upper.outline.empty();
            if (!flat || !(stack.ability & kPairManifold)) continue;
            SCOPED_TRACE(stack.name() + " beside by " + std::to_string(shift));
            stack.upper.place.x += V(shift, 0, 0.5 * shift);
            Outline moved = stack.upper.outline;
            for (auto& p : moved) p += Eigen::Vector2d(shift, 0.5 * shift);
            World world(GetParam());
            build(world, stack, -0.001);
            const auto& contacts = world.detect(kMargin);
            ASSERT_GE(contacts.size(), 3u);
            const double ideal = shared_area(moved, stack.lower.outline);
            // Eight points in a round end are an octagon, which has 0.9 of its area.
            const int curves = (moved.size() > 100) + (stack.lower.outline.size() > 100);
            const double reachable = curves == 0 ? 0.99 : curves == 1 ? 0.89 : 0.85;
            EXPECT_GE(spanned_area(contacts), reachable * ideal);
            EXPECT_LE(spanned_area(contacts), 1.001 * ideal);
        }
}

PLUMB_FOR_EACH_PLUGIN(Pairs);

}  // namespace
}  // namespace plumb::test
