// SPDX-License-Identifier: MIT
/// Closest points of two bodies: closed forms, proofs by the answer itself, each part of a compound
/// alone, and meshes of boxes against the boxes.
///
/// An answer proves itself: two surface points of the shapes bound their distance from above, and
/// the support gap along the normal bounds it from below.
#include "population.h"
#include "surfaces.h"

#include <cmath>

namespace plumb::test {
namespace {

class Closest : public EachPlugin {
protected:
    void SetUp() override {
        EachPlugin::SetUp();
        if (IsSkipped()) return;
        World world(GetParam());
        Contact c{};
        if (world.collider().closest(0, 1, &c).code == Status::unsupported)
            GTEST_SKIP() << "the plugin has no closest points";
    }

    double accuracy() const { return relative_accuracy(GetParam()); }

    /// The answer for two shapes, as bodies 2 and 5, after a detection with a small margin.
    Contact ask(const Shape& a, const Place& pa, const Shape& b, const Place& pb) const {
        World world(GetParam());
        EXPECT_EQ(world.add(2, a, pa).code, Status::ok);
        EXPECT_EQ(world.add(5, b, pb, is_fixed(b) ? Mobility::fixed : Mobility::dynamic).code,
                  Status::ok);
        world.detect(0.01);
        Contact c{};
        const Status status = world.collider().closest(5, 2, &c);
        EXPECT_EQ(status.code, Status::ok) << (status.message ? status.message : "");
        EXPECT_EQ(c.a, 2u);
        EXPECT_EQ(c.b, 5u);
        EXPECT_NE(c.flags, 0u);
        EXPECT_NEAR(v(c.normal).norm(), 1, 1e-9);
        EXPECT_NEAR(c.gap, v(c.normal).dot(v(c.point_a) - v(c.point_b)) - c.radius_a - c.radius_b,
                    1e-9);
        return c;
    }

    /// The same with a closed form: of the gap, and of the normal where it has only one.
    void expect(const Shape& a, const Place& pa, const Shape& b, const Place& pb, double gap,
                const V& normal = V::Zero()) const {
        if (!claims(a, b)) return;
        const double tolerance = gap > 0 ? 1e-9 : std::max(1e-9, accuracy());
        for (const bool a_first : {true, false}) {
            const Contact c = a_first ? ask(a, pa, b, pb) : ask(b, pb, a, pa);
            EXPECT_NEAR(c.gap, gap, tolerance);
            if (!normal.isZero()) {
                EXPECT_LT((v(c.normal) - (a_first ? normal : V(-normal))).norm(), 10 * tolerance);
            }
        }
    }

    static bool is_fixed(const Shape& shape) {
        return shape.kind == ShapeKind::plane || shape.kind == ShapeKind::height_field;
    }
};

Place at(double x, double y, double z) { return {V(x, y, z), Q::Identity()}; }
Place turned(const V& x, double angle, const V& axis) {
    return {x, Q(Eigen::AngleAxisd(angle, axis))};
}

/// Where the surfaces are that the contact names.
V on_a(const Contact& c) { return v(c.point_a) - c.radius_a * v(c.normal); }
V on_b(const Contact& c) { return v(c.point_b) + c.radius_b * v(c.normal); }

TEST_P(Closest, MeetsClosedFormsOfRoundShapes) {
    expect(sphere(.5), at(0, 3, 4), sphere(.25), {}, 4.25, V(0, .6, .8));
    expect(sphere(.5), at(0, .3, .4), sphere(.25), {}, -.25, V(0, .6, .8));
    expect(sphere(.5), at(7, 20, -3), plane(), {}, 19.5, V::UnitY());
    expect(sphere(.5), at(7, .2, -3), plane(), {}, -.3, V::UnitY());
    expect(sphere(.1), at(2, 2, 0), box(.5, 1, .5), {}, std::sqrt(3.25) - .1,
           V(1.5, 1, 0).normalized());
    expect(sphere(.1), at(.4, 0, 0), box(.5, 1, .5), {}, -.2, V::UnitX());
    expect(capsule(.1, .5), at(3, 0, 0), capsule(.2, .5), at(0, .3, 0), 2.7, V::UnitX());
    expect(capsule(.1, .5), at(0, 4, 0), capsule(.2, .5), {}, 2.7, V::UnitY());
    const Place across = turned(V(0, 0, 2), M_PI / 2, V::UnitZ());
    expect(capsule(.1, .5), across, capsule(.2, .5), {}, 1.7, V::UnitZ());
    const Place touching = turned(V(0, 0, .25), M_PI / 2, V::UnitZ());
    expect(capsule(.1, .5), touching, capsule(.2, .5), {}, -.05, V::UnitZ());
    expect(capsule(.2, .5), at(1, 3, 0), plane(), {}, 2.3, V::UnitY());
}

TEST_P(Closest, MeetsClosedFormsOfBoxes) {
    const Shape cube = box(.5, .5, .5);
    for (const Shape& other : {cube, box_hull(.5, .5, .5)}) {
        if (!claims(cube, other)) continue;
        expect(cube, at(.2, 30, -.1), other, {}, 29, V::UnitY());
        expect(cube, at(4, 5, 0), other, {}, 5, V(.6, .8, 0));
        expect(cube, at(2, 3, 3), other, {}, 3, V(1, 2, 2) / 3);
        expect(cube, at(.9, .3, .2), other, {}, -.1, V::UnitX());
        expect(cube, at(.2, -.8, .1), other, {}, -.2, -V::UnitY());
        const Place edge = turned(V(3, 0, 0), M_PI / 4, V::UnitY());
        expect(cube, edge, other, {}, 2.5 - std::sqrt(.5), V::UnitX());
    }
    expect(cube, at(9, 1.5, 2), plane(), {}, 1, V::UnitY());
    expect(cube, at(9, .4, 2), plane(), {}, -.1, V::UnitY());
}

TEST_P(Closest, ProvesItselfForConvexShapesAtAnyDistance) {
    Dice dice(5);
    const std::vector<ShapeKind> kinds = mutual_kinds(GetParam());
    for (const ShapeKind ka : kinds)
        for (const ShapeKind kb : kinds)
            for (const double distance : {2.5, 4.0, 60.0}) {
                const Shape a = any_shape(ka, dice), b = any_shape(kb, dice);
                const Place pa{distance * dice.direction(), dice.rotation()},
                    pb{V::Zero(), dice.rotation()};
                const Contact c = ask(a, pa, b, pb);
                SCOPED_TRACE(std::to_string(static_cast<int>(ka)) + " and " +
                             std::to_string(static_cast<int>(kb)));
                EXPECT_LE(outside(a, pa, on_a(c)), 1e-8 * distance);
                EXPECT_LE(outside(b, pb, on_b(c)), 1e-8 * distance);
                EXPECT_NEAR(support_gap(a, pa, b, pb, v(c.normal)), c.gap, 1e-8 * distance);
            }
}

TEST_P(Closest, KnowsTheGapOfPolyhedraThatNearlyTouchOrOverlap) {
    Dice dice(6);
    for (int i = 0; i < 60; ++i) {
        const double gap = std::vector<double>{.02, .002, -.002, -.02}[i % 4];
        const ShapeKind other = i % 3 ? ShapeKind::hull : ShapeKind::box;
        const NearPair pair = near_pair(ShapeKind::hull, other, gap, dice);
        if (!claims(pair.a, pair.b)) GTEST_SKIP() << "the plugin does not claim this";
        const Contact c = ask(pair.a, pair.pa, pair.b, pair.pb);
        EXPECT_NEAR(c.gap, pair.gap, gap > 0 ? 1e-9 : std::max(1e-6, accuracy())) << i;
    }
}

TEST_P(Closest, IsTheDeepestContactOfOverlappingShapes) {
    Dice dice(7);
    const std::vector<ShapeKind> kinds = mutual_kinds(GetParam());
    for (const ShapeKind ka : kinds)
        for (const ShapeKind kb : kinds) {
            const NearPair pair = near_pair(ka, kb, -.01, dice);
            World world(GetParam());
            world.add(0, pair.a, pair.pa);
            world.add(1, pair.b, pair.pb);
            const std::vector<Contact> contacts = world.detect(0.01);
            ASSERT_FALSE(contacts.empty());
            Contact c{};
            ASSERT_EQ(world.collider().closest(0, 1, &c).code, Status::ok);
            EXPECT_NEAR(c.gap, deepest(contacts).gap, std::max(1e-9, accuracy()));
            EXPECT_TRUE(same(contacts, world.detect(0.01))) << "a question changed the next answer";
        }
}

TEST_P(Closest, OfACompoundIsTheBestOfItsParts) {
    PLUMB_NEEDS_CLAIM(ShapeKind::compound, ShapeKind::box);
    const std::vector<std::pair<Shape, Place>> parts = {{sphere(.2), at(-1, 0, 0)},
                                                        {box(.3, .1, .2), at(0, .4, 0)},
                                                        {capsule(.1, .3), at(1, 0, 0)}};
    Dice dice(8);
    std::vector<int> won(parts.size());
    for (int i = 0; i < 40; ++i) {
        const Shape other = i % 2 ? box(.2, .3, .4) : capsule(.2, .3);
        const Place whole{V(.1, -.3, .2), dice.rotation()};
        const Place away{whole.x + dice.between(1.7, 6) * dice.direction(), dice.rotation()};
        const Contact c = ask(compound(parts), whole, other, away);
        double least = 1e300;
        std::uint32_t best = 0;
        for (std::uint32_t k = 0; k < parts.size(); ++k) {
            const double gap = ask(parts[k].first, whole * parts[k].second, other, away).gap;
            if (gap < least) least = gap, best = k;
        }
        EXPECT_NEAR(c.gap, least, 1e-9);
        EXPECT_EQ(c.part_a, best);
        ++won[best];
    }
    for (const int times : won) EXPECT_GT(times, 0) << "a part was never the nearest";
}

TEST_P(Closest, OfAMeshIsThatOfItsTriangles) {
    if (!takes(GetParam(), ShapeKind::mesh)) GTEST_SKIP() << "the plugin takes no meshes";
    const Shape cube = cube_mesh(.5, 3), ball = sphere(.1);
    expect(ball, at(.1, 3, .2), cube, {}, 2.4, V::UnitY());
    expect(ball, at(2, 3.5, 6.5), cube, {}, std::sqrt(1.5 * 1.5 + 9 + 36) - .1,
           V(1.5, 3, 6).normalized());
    expect(ball, at(.1, .55, .2), cube, {}, -.05, V::UnitY());
    expect(ball, at(.35, .05, .02), cube, {}, -.25, V::UnitX());
    expect(cube, at(.3, 8, -.2), plane(), {}, 7.5, V::UnitY());
    expect(box(.5, .5, .5), at(2, 3, 3), cube, {}, 3, V(1, 2, 2) / 3);
    expect(box(.05, .05, .05), at(.3, .1, 0), cube, {}, -.25, V::UnitX());
    expect(box(.2, .2, .2), at(.05, .69, .02), cube, {}, -.01, V::UnitY());
    expect(capsule(.1, .2), at(.05, .79, .02), cube, {}, -.01, V::UnitY());
    expect(cube, at(4, 5, 0), cube, {}, 5, V(.6, .8, 0));
    expect(cube, at(2, 3, 3), cube_mesh(.5, 2), {}, 3, V(1, 2, 2) / 3);
}

TEST_P(Closest, OfAHeightFieldIsThatOfItsTriangles) {
    if (!takes(GetParam(), ShapeKind::height_field)) GTEST_SKIP() << "the plugin takes none";
    const double slope = .3, cosine = 1 / std::hypot(1, slope);
    const Shape field = height_field(3, 12, [&](double x, double) { return slope * x; });
    const V up = V(-slope, 1, 0) * cosine;
    expect(sphere(.2), {1.5 * up, Q::Identity()}, field, {}, 1.3, up);
    expect(sphere(.2), {.15 * up, Q::Identity()}, field, {}, -.05, up);
    const double reach = .2 * (1 + slope) * cosine;
    expect(box(.2, .2, .2), {V(.3, .3 * slope, .1) + 1.5 * up, Q::Identity()}, field, {},
           1.5 - reach, up);
    const Place above = at(.1, 2, .1), through = at(.1, .03, .1);
    World world(GetParam());
    world.add(0, field, {}, Mobility::fixed);
    world.add(1, cube_mesh(.5, 2), above, Mobility::fixed);
    world.detect(0.01);
    Contact c{};
    ASSERT_EQ(world.collider().closest(0, 1, &c).code, Status::ok);
    EXPECT_NEAR(c.gap, (1.5 - .6 * slope) * cosine, 1e-9);
    world.move(1, through);
    world.detect(0.01);
    EXPECT_TRUE(world.collider().closest(0, 1, &c).code != Status::ok || c.gap < 0)
        << "surfaces that meet are not apart";
}

TEST_P(Closest, AnswersEveryQuestionThatMakesNoSenseWithASentence) {
    World world(GetParam());
    world.add(0, plane(), {}, Mobility::fixed);
    world.add(1, sphere(.5), at(0, 2, 0));
    world.add(2, plane(), at(0, -1, 0), Mobility::fixed);
    Contact c{};
    const auto code = [&](std::uint32_t a, std::uint32_t b, Contact* result) {
        const Status status = world.collider().closest(a, b, result);
        EXPECT_EQ(status.code == Status::ok, status.message == nullptr);
        return status.code;
    };
    EXPECT_EQ(code(0, 1, &c), Status::bad_argument) << "nothing was detected yet";
    world.detect(0.01);
    EXPECT_EQ(code(0, 1, &c), Status::ok);
    EXPECT_EQ(code(0, 1, nullptr), Status::bad_argument);
    EXPECT_EQ(code(1, 1, &c), Status::bad_argument);
    EXPECT_EQ(code(1, 7, &c), Status::bad_argument);
    EXPECT_EQ(code(0, 2, &c), Status::unsupported) << "two half-spaces";
    world.add(3, sphere(.5), at(0, 5, 0));
    EXPECT_EQ(code(1, 3, &c), Status::bad_argument) << "added after the detection";
    world.detect(0.01);
    EXPECT_EQ(code(1, 3, &c), Status::ok);
    world.collider().remove(3);
    EXPECT_EQ(code(1, 3, &c), Status::bad_argument);
}

TEST_P(Closest, DoesNotHeedFiltersAndStandsWhereTheLastDetectionStood) {
    World world(GetParam());
    world.add(0, sphere(.5), {}, Mobility::fixed, 1, 0);
    world.add(1, sphere(.5), at(0, .5, 0), Mobility::fixed, 2, 0);
    EXPECT_TRUE(world.detect(0.01).empty());
    world.move(1, at(0, 9, 0));
    Contact c{};
    ASSERT_EQ(world.collider().closest(0, 1, &c).code, Status::ok);
    EXPECT_NEAR(c.gap, -.5, 1e-12);
    world.detect(0.01);
    ASSERT_EQ(world.collider().closest(0, 1, &c).code, Status::ok);
    EXPECT_NEAR(c.gap, 8, 1e-12);
}

PLUMB_FOR_EACH_PLUGIN(Closest);

}  // namespace
}  // namespace plumb::test
