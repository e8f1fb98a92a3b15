// SPDX-License-Identifier: MIT
/// Two contact sets made by hand, alike but for one thing: the comparison finds that thing, and
/// nothing else.
#include "measure/contact_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace plumb {
namespace {

constexpr double kMargin = 0.005;
constexpr Quat kUpright{0, 0, 0, 1};

Shape box(double half) {
    Shape s{};
    s.kind = ShapeKind::box;
    s.half_extents = {half, half, half};
    return s;
}
Shape plane() {
    Shape s{};
    s.kind = ShapeKind::plane;
    return s;
}

Contact contact(std::uint32_t a, std::uint32_t b, const Vector3d& point, const Vector3d& normal,
                double gap) {
    Contact c{};
    c.a = a, c.b = b;
    c.point_a = to_plain(point + 0.5 * gap * normal);
    c.point_b = to_plain(point - 0.5 * gap * normal);
    c.normal = to_plain(normal);
    c.gap = gap;
    return c;
}

/// The four corners of a square of half side `half` between body a above and b below.
std::vector<Contact> square(std::uint32_t a, std::uint32_t b, double half, double gap,
                            const Vector3d& normal = Vector3d::UnitY()) {
    std::vector<Contact> contacts;
    for (double x : {-half, half})
        for (double z : {-half, half}) contacts.push_back(contact(a, b, {x, 0, z}, normal, gap));
    return contacts;
}

/// A cube of side 1 upon another, their common face at y = 0, the upper one sunk by `depth`; the
/// upper has the lower number.
struct Cubes {
    Shape shape = box(0.5);
    std::vector<ComparedBody> bodies{{&shape, {{0, 0, 0}, kUpright}},
                                     {&shape, {{0, 0, 0}, kUpright}}};
    std::vector<Pose> poses;
    ContactComparison comparison;

    explicit Cubes(double depth = 0, const ComparisonKind& kind = {})
        : poses{{{0, 0.5 - depth, 0}, kUpright}, {{0, -0.5, 0}, kUpright}},
          comparison(bodies, kind) {}

    void add(const std::vector<Contact>& first, const std::vector<Contact>& second) {
        comparison.add({first, second, poses, kMargin, 7, 0.07});
    }
    const ComparisonTotals& totals() const { return comparison.convex(); }
};

TEST(ContactComparison, EqualSetsAgreeWhateverTheNumberOfPoints) {
    Cubes cubes(0.001);
    std::vector<Contact> more = square(0, 1, 0.5, -0.001);
    more.push_back(contact(0, 1, {0.1, 0, 0.2}, Vector3d::UnitY(), -0.001));
    cubes.add(square(0, 1, 0.5, -0.001), more);
    EXPECT_TRUE(cubes.comparison.agrees());
    EXPECT_EQ(cubes.totals().agreed, 1u);
    EXPECT_EQ(cubes.totals().gap.errors.count(), 1u);
    EXPECT_EQ(cubes.totals().normal.errors.count(), 1u);
    EXPECT_EQ(cubes.totals().extent.errors.count(), 1u);
    EXPECT_TRUE(cubes.comparison.worst().empty());
}

TEST(ContactComparison, DroppedPairIsFoundOnTheSideThatLacksIt) {
    Cubes cubes(0.001);
    cubes.add({}, square(0, 1, 0.5, -0.001));
    EXPECT_EQ(cubes.totals().only_second, 1u);
    EXPECT_EQ(cubes.totals().only_first, 0u);
    EXPECT_FALSE(cubes.comparison.agrees());
    const auto worst = cubes.comparison.worst();
    ASSERT_EQ(worst.size(), 1u);
    EXPECT_EQ(worst[0].aspect, Aspect::pair);
    EXPECT_EQ(worst[0].step, 7u);
    EXPECT_TRUE(worst[0].first.empty());
    EXPECT_EQ(worst[0].second.size(), 4u);
    EXPECT_EQ(worst[0].pose_a.position.y, 0.499);
}

TEST(ContactComparison, GrazingPairsAreLeftOutAtBothEndsOfTheRange) {
    Cubes cubes;
    for (const double gap : {5e-7, -5e-7, kMargin - 5e-7, kMargin + 5e-7})
        cubes.add(square(0, 1, 0.5, gap), {});
    EXPECT_EQ(cubes.totals().grazing, 4u);
    EXPECT_EQ(cubes.totals().compared(), 0u);
    EXPECT_TRUE(cubes.comparison.agrees());
    for (const double gap : {5e-6, -5e-6, kMargin - 5e-6}) cubes.add(square(0, 1, 0.5, gap), {});
    EXPECT_EQ(cubes.totals().only_first, 3u);
}

TEST(ContactComparison, SinglePrecisionWidensTheBandsAndTheGaps) {
    Cubes cubes(0.001, {true, false});
    cubes.add(square(0, 1, 0.5, 1.5e-4), {});
    cubes.add(square(0, 1, 0.5, -0.001), square(0, 1, 0.5, -0.001 - 1.5e-4));
    EXPECT_EQ(cubes.totals().grazing, 1u);
    EXPECT_TRUE(cubes.comparison.agrees());
    cubes.add(square(0, 1, 0.5, 2.5e-4), {});
    EXPECT_EQ(cubes.totals().only_first, 1u);
}

TEST(ContactComparison, RawAnswersNeedNotSpeakOfPartedShapes) {
    Cubes cubes(0, {false, true});
    cubes.add(square(0, 1, 0.5, 0.002), {});
    EXPECT_EQ(cubes.totals().apart, 1u);
    EXPECT_TRUE(cubes.comparison.agrees());
    cubes.add(square(0, 1, 0.5, -0.002), {});
    EXPECT_EQ(cubes.totals().only_first, 1u);
}

TEST(ContactComparison, ShiftedGapIsMeasuredInSizes) {
    Cubes cubes(0.001);
    cubes.add(square(0, 1, 0.5, -0.001), square(0, 1, 0.5, -0.0012));
    EXPECT_FALSE(cubes.comparison.agrees());
    EXPECT_EQ(cubes.totals().gap.within, 0u);
    EXPECT_NEAR(cubes.totals().gap.errors.largest(), 2e-4, 1e-12);
    const auto worst = cubes.comparison.worst();
    ASSERT_EQ(worst.size(), 1u);
    EXPECT_EQ(worst[0].aspect, Aspect::gap);
    EXPECT_NEAR(worst[0].severity(), 2, 1e-9);
}

TEST(ContactComparison, DeepGapsHaveAToleranceOfTheirOwn) {
    Cubes cubes(0.1);
    cubes.add(square(0, 1, 0.5, -0.1), square(0, 1, 0.5, -0.11));
    EXPECT_TRUE(cubes.comparison.agrees());
    EXPECT_EQ(cubes.totals().gap.errors.count(), 0u);
    cubes.add(square(0, 1, 0.5, -0.1), square(0, 1, 0.5, -0.13));
    EXPECT_FALSE(cubes.comparison.agrees());
    EXPECT_EQ(cubes.totals().deep_gap.errors.count(), 2u);
}

TEST(ContactComparison, FlippedNormalIsFound) {
    Cubes cubes(0.001);
    const Vector3d down = -Vector3d::UnitY();
    cubes.add(square(0, 1, 0.5, -0.001), square(0, 1, 0.5, -0.001, down));
    EXPECT_EQ(cubes.totals().ambiguous, 0u);
    EXPECT_FALSE(cubes.comparison.agrees());
    EXPECT_NEAR(cubes.totals().normal.errors.largest(), 180, 1e-9);
    // what spans the same face the wrong way round is no patch to compare
    EXPECT_EQ(cubes.totals().extent.errors.count(), 0u);
}

TEST(ContactComparison, NormalALittleOffIsNoSecondAxis) {
    for (const double degrees : {0.5, 2.0, 10.0}) {
        Cubes cubes(0.001);
        const double angle = degrees * std::numbers::pi / 180;
        const Vector3d tilted(std::sin(angle), std::cos(angle), 0);
        cubes.add(square(0, 1, 0.5, -0.001), square(0, 1, 0.5, -0.001, tilted));
        EXPECT_EQ(cubes.totals().ambiguous, 0u) << degrees;
        EXPECT_EQ(cubes.totals().normal.within, degrees < 1 ? 1u : 0u) << degrees;
        EXPECT_NEAR(cubes.totals().normal.errors.largest(), degrees, 1e-6);
    }
}

TEST(ContactComparison, RoundShapesHaveOneAxis) {
    // 2° beside the one best axis of two balls the gap is less by 0.0006 of their size only.
    Shape ball{};
    ball.kind = ShapeKind::sphere;
    ball.radius = 0.5;
    ContactComparison comparison({{&ball, {{0, 0, 0}, kUpright}}, {&ball, {{0, 0, 0}, kUpright}}},
                                 {});
    const std::vector<Pose> poses{{{0, 0.999, 0}, kUpright}, {{0, 0, 0}, kUpright}};
    const double angle = 2 * std::numbers::pi / 180;
    const Vector3d tilted(std::sin(angle), std::cos(angle), 0);
    const std::vector<Contact> first{contact(0, 1, {0, 0.5, 0}, Vector3d::UnitY(), -0.001)},
        second{contact(0, 1, {0, 0.5, 0}, tilted, -0.001)};
    comparison.add({first, second, poses, kMargin});
    EXPECT_EQ(comparison.convex().ambiguous, 0u);
    EXPECT_FALSE(comparison.agrees());
}

TEST(ContactComparison, EquallyGoodAxesAreNotCompared) {
    // Corner to corner along x and y: the upper cube sits 1 − 0.001 to the side, and is sunk as
    // much.
    Cubes cubes(0.001);
    cubes.poses[0].position.x = 0.999;
    cubes.add(square(0, 1, 0.01, -0.001), square(0, 1, 0.01, -0.001, Vector3d::UnitX()));
    EXPECT_EQ(cubes.totals().ambiguous, 1u);
    EXPECT_TRUE(cubes.comparison.agrees());
    // Where the axis x is worse by 0.01 of the size, its normal is wrong.
    cubes.poses[0].position.x = 0.989;
    cubes.add(square(0, 1, 0.01, -0.001), square(0, 1, 0.01, -0.001, Vector3d::UnitX()));
    EXPECT_EQ(cubes.totals().ambiguous, 1u);
    EXPECT_FALSE(cubes.comparison.agrees());
}

TEST(ContactComparison, DeepNormalsAreReportedAndNotJudged) {
    Cubes cubes(0.1);
    cubes.add(square(0, 1, 0.5, -0.1), square(0, 1, 0.5, -0.1, Vector3d::UnitX()));
    EXPECT_TRUE(cubes.comparison.agrees());
    EXPECT_EQ(cubes.totals().deep_normal.within, 0u);
    ASSERT_EQ(cubes.comparison.worst().size(), 1u);
    EXPECT_EQ(cubes.comparison.worst()[0].aspect, Aspect::deep_normal);
}

TEST(ContactComparison, SmallerAreaIsFound) {
    Cubes cubes(0.001);
    cubes.add(square(0, 1, 0.5, -0.001), square(0, 1, 0.45, -0.001));
    EXPECT_FALSE(cubes.comparison.agrees());
    EXPECT_NEAR(cubes.totals().extent.errors.largest(), 1 - 0.81, 1e-9);
    // raw answers may keep but six tenths
    Cubes raw(0.001, {false, true});
    raw.add(square(0, 1, 0.5, -0.001), square(0, 1, 0.45, -0.001));
    EXPECT_TRUE(raw.comparison.agrees());
}

TEST(ContactComparison, LinesAreComparedByTheirLength) {
    Cubes cubes(0.001);
    const auto line = [](double half) {
        return std::vector<Contact>{contact(0, 1, {-half, 0, 0}, Vector3d::UnitY(), -0.001),
                                    contact(0, 1, {half, 0, 0}, Vector3d::UnitY(), -0.001)};
    };
    cubes.add(line(0.5), line(0.25));
    EXPECT_NEAR(cubes.totals().extent.errors.largest(), 0.5, 1e-9);
    cubes.add({line(0.5)[0]}, {line(0.5)[1]});  // points have no extent
    EXPECT_EQ(cubes.totals().extent.errors.count(), 1u);
}

TEST(ContactComparison, SizeIsThatOfTheSmallerBodyAndAPlaneHasNone) {
    const Shape ground = plane(), small = box(0.05);
    ContactComparison comparison(
        {{&ground, {{0, 0, 0}, kUpright}}, {&small, {{0, 0, 0}, kUpright}}}, {});
    const std::vector<Pose> poses{{{0, 0, 0}, kUpright}, {{0, 0.05, 0}, kUpright}};
    const Vector3d down = -Vector3d::UnitY();
    const auto first = square(0, 1, 0.05, 0, down), second = square(0, 1, 0.05, 2e-5, down);
    comparison.add({first, second, poses, kMargin});
    EXPECT_NEAR(comparison.convex().gap.errors.largest(), 2e-4, 1e-9);  // 2e-5 m of 0.1 m
    EXPECT_FALSE(comparison.agrees());
}

TEST(ContactComparison, KeepsTheWorstOfEachPairOfBodies) {
    Cubes cubes(0.001);
    for (const double error : {3e-4, 9e-4, 6e-4})
        cubes.add(square(0, 1, 0.5, -0.001), square(0, 1, 0.5, -0.001 - error));
    const auto worst = cubes.comparison.worst();
    ASSERT_EQ(worst.size(), 1u);
    EXPECT_NEAR(worst[0].error, 9e-4, 1e-12);
}

TEST(ContactComparison, SpreadsQuantilesAreWithinTwoAndAHalfPercent) {
    Spread spread;
    for (int i = 1; i <= 1000; ++i) spread.add(1e-6 * i);
    EXPECT_EQ(spread.count(), 1000u);
    for (const double p : {0.01, 0.5, 0.99}) {
        EXPECT_GE(spread.quantile(p), 1e-3 * p * 0.999);
        EXPECT_LE(spread.quantile(p), 1e-3 * p * 1.025);
    }
    EXPECT_EQ(spread.quantile(1), 1e-3);
    EXPECT_EQ(Spread().quantile(0.5), 0);
}

}  // namespace
}  // namespace plumb
