// SPDX-License-Identifier: MIT
/// What may touch what: mobility, groups, masks, exclusions, and the caller's own choice.
#include "population.h"
#include "standing.h"

#include <set>

namespace plumb::test {
namespace {

class Filters : public EachPlugin {
protected:
    /// The first stack that the plugin claims, on a world of its own.
    Stack any_stack() const { return stacks(GetParam()).at(0); }

    /// Adds it with filters of the upper body: id 1 below, 2 above.
    void add(World& world, std::uint32_t group, std::uint32_t mask) const {
        const Stack s = any_stack();
        Place at = s.upper.place;
        at.x.y() -= 0.002;
        world.add(1, s.lower.shape, s.lower.place, Mobility::fixed, 1, 5);
        world.add(2, s.upper.shape, at, Mobility::dynamic, group, mask);
    }
};

TEST_P(Filters, TwoBodiesOfWhichNoneIsDynamicNeverTouch) {
    const Stack s = any_stack();
    for (Mobility below : {Mobility::fixed, Mobility::kinematic, Mobility::dynamic})
        for (Mobility above : {Mobility::fixed, Mobility::kinematic, Mobility::dynamic}) {
            if (s.lower.shape.kind == ShapeKind::plane && below == Mobility::dynamic) continue;
            World world(GetParam());
            Place at = s.upper.place;
            at.x.y() -= 0.002;
            world.add(1, s.lower.shape, s.lower.place, below);
            world.add(2, s.upper.shape, at, above);
            const bool one_moves = below == Mobility::dynamic || above == Mobility::dynamic;
            EXPECT_EQ(!world.detect(0.01).empty(), one_moves);
        }
}

TEST_P(Filters, GroupsAndMasksMustMatchBothWays) {
    // Below: group 1, mask 5.
    for (std::uint32_t group : {1u, 2u, 4u, 6u})
        for (std::uint32_t mask : {0u, 1u, 2u, 3u, ~0u}) {
            World world(GetParam());
            add(world, group, mask);
            EXPECT_EQ(!world.detect(0.01).empty(), (group & 5u) != 0 && (mask & 1u) != 0)
                << "group " << group << ", mask " << mask;
        }
}

TEST_P(Filters, ExcludedPairsComeBackWhenLetIn) {
    World world(GetParam());
    add(world, 1, ~0u);
    const std::vector<Contact> first = world.detect(0.01);
    ASSERT_FALSE(first.empty());
    EXPECT_EQ(world.collider().exclude(2, 1, true).code, Status::ok);
    EXPECT_TRUE(world.detect(0.01).empty());
    EXPECT_EQ(world.collider().exclude(1, 2, false).code, Status::ok);
    EXPECT_TRUE(same(world.detect(0.01), first));
}

TEST_P(Filters, AnExclusionEndsWithItsBody) {
    World world(GetParam());
    add(world, 1, ~0u);
    EXPECT_EQ(world.collider().exclude(1, 2, true).code, Status::ok);
    EXPECT_EQ(world.collider().remove(2).code, Status::ok);
    const Stack s = any_stack();
    Place at = s.upper.place;
    at.x.y() -= 0.002;
    world.add(2, s.upper.shape, at);
    EXPECT_FALSE(world.detect(0.01).empty()) << "a new body under an old id";
}

/// Wants every second candidate, and notes what it was asked.
struct EverySecond {
    std::vector<CandidatePair> asked;
    std::set<std::pair<std::uint32_t, std::uint32_t>> wanted;
    int calls = 0;

    static void choose(void* ctx, const CandidatePair* pairs, std::uint32_t count,
                       std::uint8_t* answer) {
        auto& self = *static_cast<EverySecond*>(ctx);
        ++self.calls;
        for (std::uint32_t i = 0; i < count; ++i) {
            self.asked.push_back(pairs[i]);
            answer[i] = i % 2;
            if (i % 2) self.wanted.insert({pairs[i].a, pairs[i].b});
        }
    }
};

TEST_P(Filters, TheCallerChoosesAmongCandidates) {
    if (mutual_kinds(GetParam()).empty()) GTEST_SKIP() << "no kind that meets its own kind";
    World world(GetParam());
    throw_heap(world, GetParam(), 5, 60);
    const std::vector<Contact> all = world.detect(0.01);
    EverySecond chooser;
    const PairFilter filter{&chooser, EverySecond::choose};
    world.filter = &filter;
    const std::vector<Contact> chosen = world.detect(0.01);
    EXPECT_EQ(chooser.calls, 1) << "candidates are asked for once, all together";
    for (std::size_t i = 0; i < chooser.asked.size(); ++i) {
        const CandidatePair p = chooser.asked[i];
        EXPECT_LT(p.a, p.b);
        if (i == 0) continue;
        const CandidatePair q = chooser.asked[i - 1];
        EXPECT_LT(std::pair(q.a, q.b), std::pair(p.a, p.b)) << "candidates stand sorted, each once";
    }
    // What is left is what the full answer has of the pairs that were wanted.
    std::vector<Contact> expected;
    for (const Contact& c : all)
        if (chooser.wanted.count({c.a, c.b})) expected.push_back(c);
    EXPECT_FALSE(expected.empty());
    EXPECT_LT(expected.size(), all.size());
    EXPECT_TRUE(same(chosen, expected));
    world.filter = nullptr;
    EXPECT_TRUE(same(world.detect(0.01), all)) << "a choice holds for one call";
}

PLUMB_FOR_EACH_PLUGIN(Filters);

}  // namespace
}  // namespace plumb::test
