// SPDX-License-Identifier: MIT
/// The answer does not depend on which body is first, how bodies are numbered, or where the world
/// stands.
#include "population.h"

namespace plumb::test {
namespace {

class Invariance : public EachPlugin {
protected:
    /// One near pair of each two solid kinds, shallow and apart.
    std::vector<NearPair> near_pairs() const {
        std::vector<NearPair> pairs;
        Dice dice(31);
        for (ShapeKind a : solid_kinds())
            for (ShapeKind b : solid_kinds()) {
                if (!claims(a, b)) continue;
                for (int i = 0; i < 4; ++i) pairs.push_back(near_pair(a, b, -0.002, dice));
                if (claims(a, b, kPairSeparated)) pairs.push_back(near_pair(a, b, 0.004, dice));
            }
        return pairs;
    }

    /// Two answers to one question, the second with normals of the given sign.
    void compare(const std::vector<Contact>& p, const std::vector<Contact>& q, const Q& turned,
                 double sign) {
        ASSERT_FALSE(p.empty());
        ASSERT_FALSE(q.empty());
        const Contact &c = deepest(p), &d = deepest(q);
        const bool approximate = (c.flags | d.flags) & kContactApproximate;
        EXPECT_NEAR(c.gap, d.gap, approximate ? 1e-3 : 2 * relative_accuracy(GetParam()));
        if (!approximate) {
            EXPECT_GT((turned * v(c.normal)).dot(sign * v(d.normal)), std::cos(M_PI / 180));
        }
    }

    std::string name(const NearPair& pair) {
        return std::string(name_of(pair.a.kind)) + " and " + name_of(pair.b.kind) + " at " +
               std::to_string(pair.gap);
    }
};

TEST_P(Invariance, SwappingAAndBTurnsTheNormal) {
    for (const NearPair& pair : near_pairs()) {
        SCOPED_TRACE(name(pair));
        compare(contacts_of(GetParam(), pair, kMargin),
                contacts_of(GetParam(), pair, kMargin, {}, false), Q::Identity(), -1);
    }
}

/// Of what just touches, a nanometre must not turn the normal, or a body on its rim never rests.
TEST_P(Invariance, TinyMovesTurnTheNormalOfRimsLittle) {
    Dice dice(33);
    int pairs = 0, turned = 0;
    for (ShapeKind a : {ShapeKind::cylinder, ShapeKind::cone})
        for (ShapeKind b : solid_kinds()) {
            if (!claims(a, b, kPairManifold)) continue;
            for (int i = 0; i < 20; ++i) {
                const NearPair pair = near_pair(a, b, i % 2 ? -2e-6 : -5e-5, dice);
                NearPair moved = pair;
                moved.pb.x += 1e-9 * dice.direction();
                const auto before = contacts_of(GetParam(), pair, kMargin),
                           after = contacts_of(GetParam(), moved, kMargin);
                ASSERT_FALSE(before.empty() || after.empty());
                const V turn = v(deepest(before).normal) - v(deepest(after).normal);
                ++pairs, turned += turn.norm() > 1e-5;
            }
        }
    if (pairs == 0) GTEST_SKIP() << "no cylinders and cones";
    EXPECT_LE(turned, pairs / 100) << "of " << pairs;
}

TEST_P(Invariance, MovingTheWorldMovesTheContacts) {
    Dice dice(32);
    for (const NearPair& pair : near_pairs()) {
        SCOPED_TRACE(name(pair));
        const Place frame{3 * dice.direction(), dice.rotation()};
        compare(contacts_of(GetParam(), pair, kMargin),
                contacts_of(GetParam(), pair, kMargin, frame), frame.q, 1);
    }
}

TEST_P(Invariance, HeapsMayStandAnywhere) {
    World world(GetParam()), moved(GetParam());
    throw_heap(world, GetParam(), 3, 60);
    throw_heap(moved, GetParam(), 3, 60,
               {V(2, -1, .5), Q(Eigen::AngleAxisd(1.1, V(1, 2, 3).normalized()))});
    // Deep overlaps have several ways out, so only shallow ones are compared.
    const Gaps own = deepest_of_pairs(world.detect(kMargin));
    const Gaps other = deepest_of_pairs(moved.detect(kMargin));
    for (const auto& [pair, gap] : own) {
        if (gap > kMargin - 1e-3) continue;
        ASSERT_TRUE(other.count(pair)) << pair.first << " and " << pair.second;
        if (gap > -0.005) {
            EXPECT_NEAR(gap, other.at(pair), 1e-4);
        }
    }
}

TEST_P(Invariance, BodiesMayBeNumberedInAnyOrder) {
    World world(GetParam()), renamed(GetParam());
    throw_heap(world, GetParam(), 4, 60);
    throw_heap(renamed, GetParam(), 4, 60, {}, true);
    const Gaps own = deepest_of_pairs(world.detect(kMargin));
    const Gaps other = deepest_of_pairs(renamed.detect(kMargin));
    for (const auto& [pair, gap] : own) {
        if (gap > kMargin - 1e-3) continue;
        const auto same_pair = other.find({59 - pair.second, 59 - pair.first});
        ASSERT_TRUE(same_pair != other.end()) << pair.first << " and " << pair.second;
        if (gap > -0.005) {
            EXPECT_NEAR(gap, same_pair->second, 1e-4);
        }
    }
}

TEST_P(Invariance, FarFromTheOriginNothingChanges) {
    // Single precision has steps of a millimetre at 10 km, but poses are double: a back-end can be
    // asked in a frame near the pair.
    const double far = 1e4;
    const double accuracy = relative_accuracy(GetParam());
    const double tolerance = accuracy > 1e-4 ? accuracy : 1e-5;
    for (const NearPair& pair : near_pairs()) {
        SCOPED_TRACE(name(pair));
        const auto near_by = contacts_of(GetParam(), pair, kMargin);
        const auto far_off =
            contacts_of(GetParam(), pair, kMargin, {V(far, -far, far), Q::Identity()});
        ASSERT_FALSE(far_off.empty());
        EXPECT_NEAR(deepest(near_by).gap, deepest(far_off).gap,
                    deepest(near_by).flags & kContactApproximate ? 1e-3 : tolerance);
    }
}

PLUMB_FOR_EACH_PLUGIN(Invariance);

}  // namespace
}  // namespace plumb::test
