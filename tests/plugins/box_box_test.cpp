// SPDX-License-Identifier: MIT
/// Random boxes against an independent separating-axis answer, and the points of boxes at rest.
#include "harness.h"

#include <array>
#include <random>

namespace plumb::test {
namespace {

class BoxBox : public EachPlugin {};

/// Best axis of fifteen, and the second best that points elsewhere: where both are near, the normal
/// is open.
struct Answer {
    V n;  ///< out of b towards a
    double gap = -1e300, second = -1e300;
};

double reach(const V& h, const Q& q, const V& n) { return (q.conjugate() * n).cwiseAbs().dot(h); }

Answer separating_axes(const V& ha, const Place& a, const V& hb, const Place& b) {
    Answer r;
    std::vector<V> axes;
    for (int i = 0; i < 3; ++i) axes.insert(axes.end(), {a.q * V::Unit(i), b.q * V::Unit(i)});
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const V m = (a.q * V::Unit(i)).cross(b.q * V::Unit(j));
            if (m.norm() > 1e-5) axes.push_back(m.normalized());
        }
    for (V n : axes) {
        if (n.dot(a.x - b.x) < 0) n = -n;
        const double gap = n.dot(a.x - b.x) - reach(ha, a.q, n) - reach(hb, b.q, n);
        if (gap > r.gap) {
            if (r.n.dot(n) < 0.9998) r.second = r.gap;
            r.gap = gap, r.n = n;
        } else if (gap > r.second && r.n.dot(n) < 0.9998) {
            r.second = gap;
        }
    }
    return r;
}

class Boxes {
public:
    explicit Boxes(unsigned seed) : random_(seed) {}
    Q any_turn() {
        Q q(normal_(random_), normal_(random_), normal_(random_), normal_(random_));
        return q.normalized();
    }
    V any_way() { return V(normal_(random_), normal_(random_), normal_(random_)).normalized(); }
    V any_half() { return V(size_(random_), size_(random_), size_(random_)); }

private:
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::uniform_real_distribution<double> size_{0.3, 0.7};
};

/// Moves a along the way out of b until the widest gap of fifteen axes is `gap`.
Answer bring_to(double gap, const V& ha, Place& a, const V& hb, const Place& b, const V& way) {
    double low = 0, high = 4;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        a.x = b.x + middle * way;
        (separating_axes(ha, a, hb, b).gap < gap ? low : high) = middle;
    }
    return separating_axes(ha, a, hb, b);
}

TEST_P(BoxBox, AgreesWithSeparatingAxes) {
    PLUMB_NEEDS_CLAIM(ShapeKind::box, ShapeKind::box, kPairManifold);
    Boxes random(7);
    int wrong_normals = 0, wrong_depths = 0, compared = 0;
    World world(GetParam());
    for (int i = 0; i < 1000; ++i) {
        const V ha = random.any_half(), hb = random.any_half();
        Place a{V::Zero(), random.any_turn()}, b{V(1, 2, 3), random.any_turn()};
        const double gap = i % 2 ? -0.0005 : -0.005;
        const Answer answer = bring_to(gap, ha, a, hb, b, random.any_way());
        ASSERT_EQ(world.add(1, box(ha.x(), ha.y(), ha.z()), a).code, Status::ok);
        ASSERT_EQ(world.add(2, box(hb.x(), hb.y(), hb.z()), b).code, Status::ok);
        const auto& contacts = world.detect(0.002);
        ASSERT_FALSE(contacts.empty()) << "pair " << i << " was missed";
        expect_sound(contacts, 0.002);
        const double error = std::abs(deepest(contacts).gap - answer.gap);
        EXPECT_LT(error, 1e-3) << "pair " << i;
        wrong_depths += error > 1e-4;
        if (answer.gap - answer.second > 1e-3) {
            ++compared;
            wrong_normals += v(deepest(contacts).normal).dot(answer.n) < std::cos(M_PI / 180);
        }
        world.collider().remove(1);
        world.collider().remove(2);
    }
    EXPECT_GT(compared, 700);
    EXPECT_LE(wrong_depths, 10) << "depths off by more than 0.1 mm, of 1000";
    EXPECT_LE(wrong_normals, compared / 200)
        << "normals off by more than a degree, of " << compared;
}

/// Boxes side by side, whose edges are parallel but for rounding: products of these are noise, in
/// which an axis may seem to part them.
TEST_P(BoxBox, FindsBoxesSideBySide) {
    PLUMB_NEEDS_CLAIM(ShapeKind::box, ShapeKind::box, kPairManifold);
    Boxes random(17);
    World world(GetParam());
    for (int i = 0; i < 600; ++i) {
        const V ha = random.any_half(), hb = i % 3 == 0 ? ha : random.any_half();
        const Q turn = random.any_turn();
        const double tilt = std::pow(10, -8 - i % 10);
        const Q tilted(Eigen::AngleAxisd(i % 2 == 0 ? 0 : tilt, random.any_way()));
        const double gap = std::array{-0.03, -0.011, -0.002, 0.0, 0.004}[i % 5];
        const double aside = i % 4 == 0 ? 0 : 0.2;
        const Place b{V(1, 2, 3), turn};
        const Place a{b.x + turn * V(ha.x() + hb.x() + gap, aside, -aside), turn * tilted};
        ASSERT_EQ(world.add(1, box(ha.x(), ha.y(), ha.z()), a).code, Status::ok);
        ASSERT_EQ(world.add(2, box(hb.x(), hb.y(), hb.z()), b).code, Status::ok);
        const auto& contacts = world.detect(0.01);
        ASSERT_FALSE(contacts.empty()) << "pair " << i << " was missed, gap " << gap;
        EXPECT_NEAR(deepest(contacts).gap, gap, 1e-4) << "pair " << i;
        EXPECT_GT(v(deepest(contacts).normal).dot(turn * V::UnitX()), 1 - 1e-6) << "pair " << i;
        world.collider().remove(1);
        world.collider().remove(2);
    }
}

/// How far a point lies outside of a box [m].
double outside(const V& h, const Place& at, const V& p) {
    const V own = at.q.conjugate() * (p - at.x);
    return (own - own.cwiseMax(-h).cwiseMin(h)).norm();
}

TEST_P(BoxBox, MeasuresBoxesThatAreApart) {
    PLUMB_NEEDS_CLAIM(ShapeKind::box, ShapeKind::box, kPairSeparated);
    // A gap is proved: two points of the boxes are that near, and a slab of that width parts the
    // boxes.
    Boxes random(11);
    World world(GetParam());
    for (int i = 0; i < 300; ++i) {
        const V ha = random.any_half(), hb = random.any_half();
        Place a{V::Zero(), random.any_turn()}, b{V(1, 2, 3), random.any_turn()};
        bring_to(0.005, ha, a, hb, b, random.any_way());
        world.add(1, box(ha.x(), ha.y(), ha.z()), a);
        world.add(2, box(hb.x(), hb.y(), hb.z()), b);
        const auto& contacts = world.detect(0.05);
        ASSERT_FALSE(contacts.empty()) << "pair " << i << " was missed";
        const Contact& c = deepest(contacts);
        const V n = v(c.normal);
        EXPECT_NEAR(n.dot(a.x - b.x) - reach(ha, a.q, n) - reach(hb, b.q, n), c.gap, 1e-5)
            << "pair " << i;
        EXPECT_LT(outside(ha, a, v(c.point_a)), 1e-5) << "pair " << i;
        EXPECT_LT(outside(hb, b, v(c.point_b)), 1e-5) << "pair " << i;
        world.collider().remove(1);
        world.collider().remove(2);
    }
}

double resting_area(World& world, double degrees, double gap) {
    const Q turned(Eigen::AngleAxisd(degrees * M_PI / 180, V::UnitY()));
    world.move(1, {V::Zero(), Q::Identity()});
    world.move(2, {V(0, 1 + gap, 0), turned});
    const auto& contacts = world.detect(0.01);
    return contacts.empty() ? 0 : spanned_area(contacts);
}

TEST_P(BoxBox, SpansTheAreaOfRestingBoxes) {
    PLUMB_NEEDS_CLAIM(ShapeKind::box, ShapeKind::box, kPairManifold);
    World world(GetParam());
    world.add(1, box(.5, .5, .5), {}, Mobility::fixed);
    world.add(2, box(.5, .5, .5), {});
    for (double gap : {-0.002, 0.0, 0.002}) {
        EXPECT_NEAR(resting_area(world, 0, gap), 1, 1e-3);
        EXPECT_EQ(world.last().size(), 4u);
        const double octagon = 2 * (std::sqrt(2) - 1);
        EXPECT_GE(resting_area(world, 45, gap), 0.99 * octagon);
        EXPECT_LE(world.last().size(), 8u);
    }
}

TEST_P(BoxBox, KeepsFeatureKeysUnderSmallMotions) {
    PLUMB_NEEDS_CLAIM(ShapeKind::box, ShapeKind::box, kPairManifold);
    World world(GetParam());
    world.add(1, box(2, .5, 2), {}, Mobility::fixed);
    world.add(2, box(.5, .5, .5), {});
    const Q first(Eigen::AngleAxisd(0.5, V::UnitY()));
    world.move(2, {V(.1, .998, .2), first});
    std::vector<std::uint64_t> keys;
    for (const Contact& c : world.detect(0.01)) keys.push_back(c.feature);
    ASSERT_EQ(keys.size(), 4u);
    for (int i = 0; i < 20; ++i) {
        const Q turned(Eigen::AngleAxisd(1e-4 * std::sin(i), V(1, .3 * i, 2).normalized()));
        world.move(2, {V(.1 + 1e-3 * i, .998 + 1e-4 * std::cos(i), .2), turned * first});
        std::vector<std::uint64_t> now;
        for (const Contact& c : world.detect(0.01)) now.push_back(c.feature);
        EXPECT_EQ(now, keys) << "motion " << i;
    }
}

PLUMB_FOR_EACH_PLUGIN(BoxBox);

}  // namespace
}  // namespace plumb::test
