// SPDX-License-Identifier: MIT
/// What the contract promises beside geometry: filters, order, purity, refusals, and calm in the
/// face of bad numbers.
#include "harness.h"

#include <cstring>
#include <limits>
#include <random>

namespace plumb::test {
namespace {

class Rules : public EachPlugin {
protected:
    /// Whether the plugin claims planes, spheres, boxes and capsules, all with all.
    bool claims_usual_kinds() const {
        const ShapeKind usual[] = {ShapeKind::plane, ShapeKind::sphere, ShapeKind::box,
                                   ShapeKind::capsule};
        for (ShapeKind a : usual)
            for (ShapeKind b : usual)
                if (!(a == b && a == ShapeKind::plane) && !claims(a, b)) return false;
        return true;
    }
};

#define PLUMB_NEEDS_USUAL_KINDS \
    if (!claims_usual_kinds()) GTEST_SKIP() << "the plugin does not claim all usual kinds"

Place up(double h) { return {V(0, h, 0), Q::Identity()}; }

TEST_P(Rules, NeverTestsTwoBodiesThatAreNotDynamic) {
    PLUMB_NEEDS_USUAL_KINDS;
    World world(GetParam());
    world.add(0, box(1, 1, 1), {}, Mobility::fixed);
    world.add(1, sphere(1), {}, Mobility::kinematic);
    world.add(2, plane(), {}, Mobility::fixed);
    EXPECT_TRUE(world.detect(0.01).empty());
    world.add(3, sphere(.1), up(1.05));
    EXPECT_EQ(world.detect(0.01).size(), 2u) << "with the box and with the large sphere";
}

TEST_P(Rules, HeedsGroupsAndMasks) {
    PLUMB_NEEDS_CLAIM(ShapeKind::plane, ShapeKind::sphere);
    for (std::uint32_t mask : {1u, 2u, 3u}) {
        World world(GetParam());
        world.add(0, plane(), {}, Mobility::fixed, 1, ~0u);
        world.add(1, sphere(.5), up(.5), Mobility::dynamic, 2, mask);
        EXPECT_EQ(world.detect(0.01).size(), mask & 1 ? 1u : 0u) << "mask " << mask;
    }
}

TEST_P(Rules, ExcludesPairsAndLetsThemInAgain) {
    PLUMB_NEEDS_USUAL_KINDS;
    World world(GetParam());
    world.add(4, sphere(.5), up(0));
    world.add(7, sphere(.5), up(.9));
    EXPECT_EQ(world.detect(0.01).size(), 1u);
    EXPECT_EQ(world.collider().exclude(7, 4, true).code, Status::ok);
    EXPECT_TRUE(world.detect(0.01).empty());
    EXPECT_EQ(world.collider().exclude(4, 7, false).code, Status::ok);
    EXPECT_EQ(world.detect(0.01).size(), 1u);
}

TEST_P(Rules, AddsAndRemovesUnderWay) {
    PLUMB_NEEDS_USUAL_KINDS;
    World world(GetParam());
    world.add(0, plane(), {}, Mobility::fixed);
    for (std::uint32_t i = 1; i < 20; ++i) world.add(i, sphere(.4), {V(i, .4, 0), Q::Identity()});
    EXPECT_EQ(world.detect(0.01).size(), 19u);
    for (std::uint32_t i = 1; i < 20; i += 2)
        EXPECT_EQ(world.collider().remove(i).code, Status::ok);
    EXPECT_EQ(world.detect(0.01).size(), 9u);
    EXPECT_EQ(world.collider().remove(1).code, Status::bad_argument);
    EXPECT_EQ(world.add(3, box(.4, .4, .4), {V(3, .4, 0), Q::Identity()}).code, Status::ok);
    EXPECT_EQ(world.detect(0.01).size(), 13u);
    EXPECT_EQ(world.add(3, sphere(1), {}).code, Status::bad_argument) << "the id is in use";
}

TEST_P(Rules, RefusesWhatItCannotDo) {
    World world(GetParam());
    for (const Shape& shape : {plane(), sphere(1), box(1, 1, 1), capsule(1, 1), cylinder(1, 1),
                               cone(1, 1), box_hull(1, 1, 1), grid_mesh(1, 2)}) {
        const bool known = takes(GetParam(), shape.kind);
        const Status status = world.add(9, shape, {});
        EXPECT_EQ(status.code, known ? Status::ok : Status::unsupported) << name_of(shape.kind);
        if (known)
            world.collider().remove(9);
        else
            EXPECT_GT(std::strlen(status.message ? status.message : ""), 20u) << "says why";
    }
    for (const Shape& shape :
         {sphere(-1), box(1, 0, 1), capsule(std::numeric_limits<double>::quiet_NaN(), 1)})
        if (takes(GetParam(), shape.kind)) {
            EXPECT_EQ(world.add(9, shape, {}).code, Status::bad_argument) << name_of(shape.kind);
        }
}

/// Some boxes, spheres and capsules thrown together.
void fill(World& world, unsigned seed, const Place& frame = {}, bool backwards = false) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    const std::uint32_t count = 40;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Place at{1.5 * V(u(random), u(random), u(random)),
                       Q(u(random), u(random), u(random), u(random)).normalized()};
        const Shape shape = i % 3 == 0   ? box(.3, .2, .25)
                            : i % 3 == 1 ? sphere(.25)
                                         : capsule(.15, .3);
        world.add(backwards ? count - 1 - i : i, shape, frame * at);
    }
}

TEST_P(Rules, AnswersTheSameWhenAskedAgain) {
    PLUMB_NEEDS_USUAL_KINDS;
    World world(GetParam());
    fill(world, 1);
    const std::vector<Contact> first = world.detect(0.01);
    ASSERT_GT(first.size(), 20u);
    expect_sound(first, 0.01);
    const std::vector<Contact> wide = world.detect(0.2);
    EXPECT_GT(wide.size(), first.size());
    EXPECT_TRUE(same(world.detect(0.01), first)) << "an answer depends on what was asked before";

    // Bodies that went elsewhere and came back leave no trace either.
    World other(GetParam());
    fill(other, 2);
    other.detect(0.05);
    World again(GetParam());
    fill(again, 1);
    EXPECT_TRUE(same(again.detect(0.01), first)) << "two worlds share a memory";
}

TEST_P(Rules, DoesNotMindWhereTheWorldStands) {
    PLUMB_NEEDS_USUAL_KINDS;
    World world(GetParam()), moved(GetParam());
    fill(world, 3);
    fill(moved, 3, {V(2, -1, .5), Q(Eigen::AngleAxisd(1.1, V(1, 2, 3).normalized()))});
    const Gaps own = deepest_of_pairs(world.detect(0.01)),
               other = deepest_of_pairs(moved.detect(0.01));
    ASSERT_EQ(own.size(), other.size());
    for (const auto& [pair, gap] : own) EXPECT_NEAR(gap, other.at(pair), 1e-4);
}

TEST_P(Rules, DoesNotMindHowBodiesAreNumbered) {
    PLUMB_NEEDS_USUAL_KINDS;
    World world(GetParam()), renamed(GetParam());
    fill(world, 4);
    fill(renamed, 4, {}, true);
    const Gaps own = deepest_of_pairs(world.detect(0.01)),
               other = deepest_of_pairs(renamed.detect(0.01));
    ASSERT_EQ(own.size(), other.size());
    for (const auto& [pair, gap] : own)
        EXPECT_NEAR(gap, other.at({39 - pair.second, 39 - pair.first}), 1e-4);
}

TEST_P(Rules, FindsThePairsThatTheReferenceFinds) {
    PLUMB_NEEDS_USUAL_KINDS;
    if (plugin_file("reference").empty()) GTEST_SKIP() << "the reference is not installed";
    const double margin = 0.01;
    for (unsigned seed = 10; seed < 30; ++seed) {
        World world(GetParam()), reference("reference");
        fill(world, seed);
        fill(reference, seed);
        const Gaps own = deepest_of_pairs(world.detect(margin)),
                   theirs = deepest_of_pairs(reference.detect(margin));
        for (const auto& [pair, gap] : theirs) {
            if (gap > margin - 1e-4) continue;
            ASSERT_TRUE(own.count(pair))
                << "missed " << pair.first << " and " << pair.second << " at " << gap;
            // Deep normals differ between back-ends, and depths with them; shallow ones must not.
            if (gap > -0.005) {
                EXPECT_NEAR(own.at(pair), gap, 1e-4) << pair.first << " and " << pair.second;
            }
        }
        for (const auto& [pair, gap] : own) {
            if (gap > margin - 1e-4) continue;
            EXPECT_TRUE(theirs.count(pair)) << "invented " << pair.first << " and " << pair.second;
        }
    }
}

TEST_P(Rules, LeavesOutBodiesWithoutAFinitePose) {
    PLUMB_NEEDS_USUAL_KINDS;
    World world(GetParam());
    world.add(0, plane(), {}, Mobility::fixed);
    world.add(1, box(.5, .5, .5), up(.5));
    world.add(2, sphere(.5), up(.5));
    world.add(3, box(.5, .5, .5), {V(5, .5, 0), Q::Identity()});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    world.move_raw(1, {{0, nan, 0}, {0, 0, 0, 1}});
    world.move_raw(2, {{0, .5, 0}, {0, 0, 0, 0}});
    const auto& contacts = world.detect(0.01);
    EXPECT_EQ(world.status().code, Status::failed);
    EXPECT_EQ(world.status().count, 2u);
    EXPECT_EQ(contacts.size(), 4u) << "the sound box still lies on the plane";
    world.move(1, up(.5));
    world.move(2, up(1.4));
    EXPECT_GT(world.detect(0.01).size(), 8u);
    EXPECT_EQ(world.status().code, Status::ok);
}

TEST_P(Rules, FindsANormalForCoincidentCentres) {
    PLUMB_NEEDS_USUAL_KINDS;
    const std::vector<Shape> shapes = {sphere(.5), box(.5, .5, .5), capsule(.2, .5)};
    for (const Shape& a : shapes)
        for (const Shape& b : shapes) {
            World world(GetParam());
            world.add(0, a, up(1));
            world.add(1, b, up(1));
            const std::vector<Contact> first = world.detect(0.01);
            ASSERT_FALSE(first.empty()) << name_of(a.kind) << " in " << name_of(b.kind);
            expect_sound(first, 0.01);
            EXPECT_LT(deepest(first).gap, -0.1);
            EXPECT_TRUE(same(world.detect(0.01), first));
        }
}

TEST_P(Rules, TakesCompoundsApart) {
    PLUMB_NEEDS_USUAL_KINDS;
    const Shape table = compound({{box(1, .1, 1), up(1)},
                                  {box(.1, .5, .1), {V(.8, .4, .8), Q::Identity()}},
                                  {box(.1, .5, .1), {V(-.8, .4, -.8), Q::Identity()}}});
    World world(GetParam());
    world.add(0, plane(), up(-.1), Mobility::fixed);
    world.add(1, table, {});
    const auto& contacts = world.detect(0.01);
    EXPECT_EQ(contacts.size(), 8u);
    expect_sound(contacts, 0.01);
    for (const Contact& c : contacts) EXPECT_TRUE(c.part_b == 1 || c.part_b == 2);
}

TEST_P(Rules, PutsAShapeWhereItsBodyWantsIt) {
    PLUMB_NEEDS_CLAIM(ShapeKind::plane, ShapeKind::sphere);
    World world(GetParam());
    world.add(0, plane(), {}, Mobility::fixed);
    const Place local{V(0, 0, 2), Q(Eigen::AngleAxisd(M_PI / 2, V::UnitX()))};
    const Place body{V(1, 2, 0), Q(Eigen::AngleAxisd(M_PI / 2, V::UnitX()))};
    // The body's turn takes z to −y: the sphere's centre stands at (1, 0, 0).
    world.add(1, sphere(.25), body, Mobility::dynamic, 1, ~0u, local);
    ASSERT_EQ(world.detect(0.01).size(), 1u);
    EXPECT_NEAR(world.last()[0].gap, -.25, 1e-12);
    EXPECT_NEAR((v(world.last()[0].point_b) - V(1, 0, 0)).norm(), 0, 1e-12);
}

TEST_P(Rules, AnchorsRoundShapesOnTheirCore) {
    PLUMB_NEEDS_USUAL_KINDS;
    World world(GetParam());
    world.add(0, box(1, 1, 1), up(-1), Mobility::fixed);
    world.add(1, sphere(.5), up(.498));
    world.add(2, capsule(.2, .5), {V(.6, .2, 0), Q(Eigen::AngleAxisd(M_PI / 2, V::UnitX()))});
    for (const Contact& c : world.detect(0.01)) {
        if (c.a != 0) continue;
        EXPECT_EQ(c.radius_a, 0);
        EXPECT_EQ(c.radius_b, c.b == 1 ? .5 : .2);
        EXPECT_NEAR(c.point_b.y, c.b == 1 ? .498 : .2, 1e-9);
        EXPECT_NEAR(c.point_a.y, 0, 1e-6);
    }
}

TEST_P(Rules, SaysWhenTheSinkIsFull) {
    PLUMB_NEEDS_CLAIM(ShapeKind::plane, ShapeKind::sphere);
    World world(GetParam());
    world.add(0, plane(), {}, Mobility::fixed);
    world.add(1, sphere(.5), up(.5));
    const ContactSink full{nullptr, [](void*, std::uint32_t) -> Contact* { return nullptr; }};
    const Pose poses[2] = {pose({}), pose(up(.5))};
    const DetectRequest request{poses, nullptr, 2, 0, 0.01};
    EXPECT_EQ(world.collider().detect(request, &full, 1).code, Status::out_of_memory);
}

TEST_P(Rules, TellsItsRawOpinion) {
    PLUMB_NEEDS_USUAL_KINDS;
    World world(GetParam());
    world.add(0, box(1, 1, 1), up(-1), Mobility::fixed);
    world.add(1, box(.5, .5, .5), up(.49));
    const auto& contacts = world.detect(0.01, kDetectRaw);
    ASSERT_FALSE(contacts.empty());
    expect_sound(contacts, 0.01, Features::some);
    EXPECT_NEAR(deepest(contacts).gap, -0.01, 2e-3);
    EXPECT_EQ(world.collider().stats().from_clip, 0u);
}

PLUMB_FOR_EACH_PLUGIN(Rules);

}  // namespace
}  // namespace plumb::test
