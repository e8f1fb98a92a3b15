// SPDX-License-Identifier: MIT
/// A collider is a function of shapes and poses: what was asked or stood there before does not
/// show.
#include "population.h"
#include "standing.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace plumb::test {
namespace {

class Purity : public EachPlugin {
protected:
    std::vector<Contact> fresh(unsigned seed) const {
        World world(GetParam());
        throw_heap(world, GetParam(), seed, 60);
        return world.detect(kMargin);
    }
};

TEST_P(Purity, AnswersTheSameAfterOtherMarginsAndPlaces) {
    if (mutual_kinds(GetParam()).empty()) GTEST_SKIP() << "no kind that meets its own kind";
    const std::vector<Contact> expected = fresh(1);
    ASSERT_FALSE(expected.empty());
    expect_sound(expected, kMargin);
    World world(GetParam());
    throw_heap(world, GetParam(), 1, 60);
    EXPECT_TRUE(same(world.detect(kMargin), expected));
    EXPECT_GT(world.detect(0.2).size(), expected.size());
    EXPECT_TRUE(same(world.detect(kMargin), expected)) << "after a wide margin";
    world.detect(kMargin, kDetectRaw);
    EXPECT_TRUE(same(world.detect(kMargin), expected)) << "after a raw answer";

    // All bodies go through other places, far and near, and come back.
    Dice dice(9);
    for (double spread : {1e-4, 1e-2, 1.0, 100.0}) {
        World wandering(GetParam());
        throw_heap(wandering, GetParam(), 1, 60);
        for (int i = 0; i < 5; ++i) {
            for (std::uint32_t id = 0; id < 60; ++id)
                wandering.move(id, {spread * dice.direction(), dice.rotation()});
            wandering.detect(kMargin);
        }
        World again(GetParam());
        throw_heap(again, GetParam(), 1, 60);
        for (std::uint32_t id = 0; id < 60; ++id) wandering.collider().remove(id);
        throw_heap(wandering, GetParam(), 1, 60);
        EXPECT_TRUE(same(wandering.detect(kMargin), expected)) << "after wandering by " << spread;
    }
}

TEST_P(Purity, SmallStepsAndOneJumpEndAlike) {
    for (const Stack& stack : stacks(GetParam())) {
        SCOPED_TRACE(stack.name());
        World stepping(GetParam()), jumping(GetParam());
        build(stepping, stack, 0.05);
        build(jumping, stack, -0.002);
        for (int i = 0; i <= 25; ++i) {
            Place at = stack.upper.place;
            at.x.y() += 0.05 - 0.002 * i;
            stepping.move(2, at);
            stepping.detect(kMargin);
        }
        Place end = stack.upper.place;
        end.x.y() += -0.002;
        stepping.move(2, end);
        EXPECT_TRUE(same(stepping.detect(kMargin), jumping.detect(kMargin)));
    }
}

TEST_P(Purity, BodiesComeAndGo) {
    if (mutual_kinds(GetParam()).empty()) GTEST_SKIP() << "no kind that meets its own kind";
    World world(GetParam());
    throw_heap(world, GetParam(), 6, 60);
    std::vector<Contact> expected;
    for (const Contact& c : world.detect(kMargin))
        if (c.a % 2 == 0 && c.b % 2 == 0) expected.push_back(c);
    for (std::uint32_t id = 1; id < 60; id += 2) {
        EXPECT_EQ(world.collider().remove(id).code, Status::ok);
        EXPECT_EQ(world.collider().remove(id).code, Status::bad_argument) << "removed already";
    }
    EXPECT_TRUE(same(world.detect(kMargin), expected));
    const ShapeKind kind = mutual_kinds(GetParam())[0];
    Dice dice(3);
    const Shape shape = any_shape(kind, dice);
    const ShapePlacement second{shape, pose({}), Mobility::dynamic, 1, ~0u, 0};
    EXPECT_EQ(world.collider().add(2, second).code, Status::bad_argument) << "the id is in use";
    EXPECT_EQ(world.collider().remove(500).code, Status::bad_argument) << "never added";
    // Two fresh bodies in the air meet each other alone.
    EXPECT_EQ(world.add(1, shape, {V(50, 50, 50), Q::Identity()}).code, Status::ok);
    EXPECT_EQ(world.add(3, shape, {V(50, 50, 50), Q::Identity()}).code, Status::ok);
    EXPECT_GT(world.detect(kMargin).size(), expected.size());
}

/// A few bodies come, go and are kept apart between detections: the answer is that of a collider
/// that got all that is there at once. Old ids return with more parts or fewer.
TEST_P(Purity, EditsLeaveNoTrace) {
    const std::vector<ShapeKind> kinds = mutual_kinds(GetParam());
    if (kinds.empty()) GTEST_SKIP() << "no kind that meets its own kind";
    const bool has_compounds = claims(ShapeKind::compound, ShapeKind::compound);
    constexpr std::uint32_t kIds = 120;
    struct Body {
        Shape shape;
        Place place;
    };
    std::map<std::uint32_t, Body> bodies;
    std::set<std::pair<std::uint32_t, std::uint32_t>> apart;
    Dice dice(11);
    World edited(GetParam());
    const auto any_id = [&] { return static_cast<std::uint32_t>(dice.between(0, kIds)); };
    const auto any_place = [&] { return Place{dice.within(2), dice.rotation()}; };
    const auto any_body = [&](std::uint32_t id) {
        const auto simple = [&] { return any_shape(kinds[id % kinds.size()], dice); };
        if (!has_compounds || dice.between(0, 1) < 0.8) return Body{simple(), any_place()};
        return Body{compound({{simple(), {}}, {simple(), any_place()}}), any_place()};
    };
    const auto add = [&](std::uint32_t id) {
        const Body& body = bodies[id] = any_body(id);
        EXPECT_EQ(edited.add(id, body.shape, body.place).code, Status::ok);
    };
    const auto remove = [&](std::uint32_t id) {
        EXPECT_EQ(edited.collider().remove(id).code, Status::ok);
        bodies.erase(id);
        std::erase_if(apart, [id](const auto& p) { return p.first == id || p.second == id; });
    };
    const auto exclude = [&](std::pair<std::uint32_t, std::uint32_t> pair, bool excluded) {
        EXPECT_EQ(edited.collider().exclude(pair.second, pair.first, excluded).code, Status::ok);
        excluded ? void(apart.insert(pair)) : void(apart.erase(pair));
    };
    for (std::uint32_t id = 0; id < kIds; id += 1 + id % 2) add(id);
    for (int round = 0; round < 100; ++round) {
        for (int edit = 0; edit < 3; ++edit) {
            const std::uint32_t id = any_id();
            if (bodies.contains(id) && dice.between(0, 1) < 0.5) remove(id);
            if (!bodies.contains(id)) add(id);
            if (edit == 2) remove(id);
        }
        if (!apart.empty() && round % 2 == 0) exclude(*apart.begin(), false);
        for (const Contact& c : edited.last())
            if (dice.between(0, 1) < 0.01 && bodies.contains(c.a) && bodies.contains(c.b))
                exclude({c.a, c.b}, true);
        Body& moved = bodies.begin()->second;
        edited.move(bodies.begin()->first, moved.place = any_place());
        World fresh(GetParam());
        for (const auto& [id, body] : bodies) fresh.add(id, body.shape, body.place);
        for (const auto& [a, b] : apart) fresh.collider().exclude(a, b, true);
        const std::vector<Contact>& expected = fresh.detect(kMargin);
        EXPECT_FALSE(expected.empty());
        ASSERT_TRUE(same(edited.detect(kMargin), expected)) << "round " << round;
    }
}

TEST_P(Purity, SortedByBodiesAndFeature) {
    World world(GetParam());
    throw_heap(world, GetParam(), 7, 120);
    expect_sound(world.detect(0.05), 0.05);
}

PLUMB_FOR_EACH_PLUGIN(Purity);

}  // namespace
}  // namespace plumb::test
