// SPDX-License-Identifier: MIT
/// Random pairs of convex shapes at a known gap: found, with a gap that the contact's own normal
/// proves, and with points that lie on the shapes.
#include "population.h"

namespace plumb::test {
namespace {

constexpr double kWideMargin = 0.02;

/// What was wrong with some of many pairs. A back-end's iterations may stop early now and then.
struct Count {
    int pairs = 0, off = 0, normals = 0, wrong_normals = 0;
};

class Exact : public EachPlugin {
protected:
    void meet(Count& count, const NearPair& pair) {
        const std::vector<Contact> contacts = contacts_of(GetParam(), pair, kWideMargin);
        ++count.pairs;
        ASSERT_FALSE(contacts.empty()) << "the pair was missed";
        expect_sound(contacts, kWideMargin);
        const Contact& c = deepest(contacts);
        const V n = v(c.normal);
        const double tolerance = relative_accuracy(GetParam());

        // Its own normal proves that the gap is not too large; the pair was built not to be below.
        const double proved = support_gap(pair.a, pair.pa, pair.b, pair.pb, n);
        const double error =
            std::max({c.gap - proved, pair.gap - c.gap, proved < -1e9 ? 1.0 : 0.0});
        count.off += error > 2 * tolerance;
        EXPECT_LT(error, c.flags & kContactApproximate ? 5e-3 : 1e-3)
            << "gap " << c.gap << " for " << pair.gap << ", its normal proves " << proved;
        if (pair.polyhedra && pair.gap - pair.second > 1e-3) {
            ++count.normals;
            count.wrong_normals += n.dot(pair.n) < std::cos(M_PI / 180);
        }
        if (error > 2 * tolerance) return;
        EXPECT_LT(outside(pair.a, pair.pa, v(c.point_a) - c.radius_a * n), 5 * tolerance);
        EXPECT_LT(outside(pair.b, pair.pb, v(c.point_b) + c.radius_b * n), 5 * tolerance);
    }

    /// Pairs of two kinds at some gaps.
    void meet_kinds(Count& count, ShapeKind a, ShapeKind b, int pairs, unsigned seed) {
        Dice dice(seed);
        for (int i = 0; i < pairs; ++i)
            for (double gap : {-0.005, -0.0005, 0.005}) {
                if (!claims(a, b, gap > 0 ? kPairSeparated : kPairPoint | kPairManifold)) continue;
                SCOPED_TRACE(std::string(name_of(a)) + " and " + name_of(b) + " " +
                             std::to_string(i) + " at " + std::to_string(gap));
                meet(count, near_pair(a, b, gap, dice));
            }
    }

    void expect_few(const Count& count) {
        EXPECT_LE(count.off, count.pairs / 100 + 1)
            << "gaps off by more than the precision, of " << count.pairs;
        EXPECT_LE(count.wrong_normals, count.normals / 100 + 1)
            << "normals off by more than a degree, of " << count.normals;
    }
};

TEST_P(Exact, BoxesAgreeWithSeparatingAxes) {
    PLUMB_NEEDS_CLAIM(ShapeKind::box, ShapeKind::box);
    Count count;
    meet_kinds(count, ShapeKind::box, ShapeKind::box, 300, 7);
    expect_few(count);
}

TEST_P(Exact, HullsAgreeWithSeparatingAxes) {
    PLUMB_NEEDS_CLAIM(ShapeKind::hull, ShapeKind::hull);
    Count count;
    meet_kinds(count, ShapeKind::hull, ShapeKind::hull, 100, 8);
    expect_few(count);
}

TEST_P(Exact, BoxesAndHullsAgreeWithSeparatingAxes) {
    PLUMB_NEEDS_CLAIM(ShapeKind::box, ShapeKind::hull);
    Count count;
    meet_kinds(count, ShapeKind::box, ShapeKind::hull, 100, 9);
    expect_few(count);
}

TEST_P(Exact, EverySolidMeetsEveryOther) {
    for (ShapeKind a : solid_kinds())
        for (ShapeKind b : solid_kinds()) {
            if (!claims(a, b)) continue;
            Count count;
            meet_kinds(count, a, b, 12, 10 + static_cast<unsigned>(a));
            SCOPED_TRACE(std::string(name_of(a)) + " and " + name_of(b));
            expect_few(count);
        }
}

TEST_P(Exact, SolidsMeetPlanes) {
    Dice dice(21);
    for (ShapeKind kind : solid_kinds()) {
        if (!claims(kind, ShapeKind::plane, kPairSeparated)) continue;
        for (int i = 0; i < 30; ++i) {
            const Shape shape = any_shape(kind, dice);
            const Place ground{V(1, 2, 3), dice.rotation()};
            const V up = ground.q * V::UnitY();
            Place at{V::Zero(), dice.rotation()};
            const double gap = dice.between(-0.02, 0.01);
            at.x = ground.x + (gap - up.dot(support(shape, at, -up))) * up;
            World world(GetParam());
            world.add(0, plane(), ground, Mobility::fixed);
            world.add(1, shape, at);
            SCOPED_TRACE(std::string(name_of(kind)) + " " + std::to_string(i));
            const auto& contacts = world.detect(kWideMargin);
            ASSERT_FALSE(contacts.empty());
            expect_sound(contacts, kWideMargin);
            EXPECT_NEAR(deepest(contacts).gap, gap, relative_accuracy(GetParam()));
            EXPECT_GT(-v(contacts[0].normal).dot(up), 1 - 1e-6);
        }
    }
}

PLUMB_FOR_EACH_PLUGIN(Exact);

}  // namespace
}  // namespace plumb::test
