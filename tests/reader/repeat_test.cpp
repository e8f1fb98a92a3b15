// SPDX-License-Identifier: MIT
#include <map>

#include "math/random.h"
#include "reading.h"

namespace plumb::test {

namespace {

/// A grid of two kinds of balls.
std::string with_repeat(const std::string& repeat) {
    return R"({"shapes": {"s": {"sphere": {"radius": 1}}}, "bodies": [{"repeat": {)" + repeat +
           R"(}, "bodies": [{"name": "a", "shape": "s"}, {"name": "b", "shape": "s", "weight": 3}]}]})";
}

std::map<char, int> count_by_letter(const Scene& scene) {
    std::map<char, int> count;
    for (const auto& body : scene.bodies) ++count[body.name[0]];
    return count;
}

}  // namespace

TEST(Random, IsSplitMix64) {
    // The first draws of the reference implementation for the seed 1234567.
    plumb::Random random(1234567);
    EXPECT_EQ(random.bits(), 6457827717110365317ull);
    EXPECT_EQ(random.bits(), 3203168211198807973ull);
    EXPECT_EQ(random.bits(), 9817491932198370423ull);
}

TEST(Random, RotationsAreUniform) {
    plumb::Random random(1);
    constexpr int kDraws = 20000;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    double half_angle_cosine_squared = 0;
    for (int i = 0; i < kDraws; ++i) {
        const Eigen::Quaterniond q = random.rotation();
        EXPECT_NEAR(q.norm(), 1, 1e-12);
        const Eigen::Vector3d x = q * Eigen::Vector3d::UnitX();
        mean += x / kDraws;
        second += x * x.transpose() / kDraws;
        half_angle_cosine_squared += q.w() * q.w() / kDraws;
    }
    // Uniform on the sphere: mean 0, second moment a third; and w² has mean 1/4.
    EXPECT_LT(mean.norm(), 0.02);
    EXPECT_LT((second - Eigen::Matrix3d::Identity() / 3).norm(), 0.02);
    EXPECT_NEAR(half_angle_cosine_squared, 0.25, 0.01);
}

TEST(Repeat, PlacesRunAlongXThenZThenY) {
    const Scene scene = scene_of(with_repeat(
        R"("count": [2, 2, 3], "spacing": [1, 10, 100], "origin": [5, 6, 7], "centered": [false, false, true])"));
    ASSERT_EQ(scene.bodies.size(), 12u);
    EXPECT_EQ(scene.bodies[0].placement.position, Eigen::Vector3d(5, 6, -93));
    EXPECT_EQ(scene.bodies[1].placement.position, Eigen::Vector3d(6, 6, -93));
    EXPECT_EQ(scene.bodies[2].placement.position, Eigen::Vector3d(5, 6, 7));
    EXPECT_EQ(scene.bodies[6].placement.position, Eigen::Vector3d(5, 16, -93));
    EXPECT_EQ(scene.bodies[11].placement.position, Eigen::Vector3d(6, 16, 107));
}

TEST(Repeat, DealsByWeightAndShuffles) {
    const Scene scene = scene_of(with_repeat(R"("count": [100, 1, 1], "total": 80, "seed": 5)"));
    EXPECT_EQ(count_by_letter(scene), (std::map<char, int>{{'a', 20}, {'b', 60}}));
    EXPECT_NE(scene.bodies[0].name.find("_0001"), std::string::npos);
    EXPECT_NE(scene.bodies[79].name.find("_0080"), std::string::npos);

    // Shuffled: some a stands in the last quarter, where none was dealt.
    bool shuffled = false;
    for (std::size_t i = 60; i < 80; ++i) shuffled |= scene.bodies[i].name[0] == 'a';
    EXPECT_TRUE(shuffled);
}

TEST(Repeat, IsTheSameForASeedAndDiffersForAnother) {
    const auto scene = [](const std::string& seed) {
        return scene_of(
            with_repeat("\"count\": [5, 5, 5], \"jitter\": [0.1, 0, 0.1], \"random_rotation\": "
                        "true, \"seed\": " +
                        seed));
    };
    const Scene one = scene("9"), same = scene("9"), other = scene("10");
    int moved = 0;
    for (std::size_t i = 0; i < 125; ++i) {
        EXPECT_EQ(one.bodies[i].name, same.bodies[i].name);
        EXPECT_EQ(one.bodies[i].placement.position, same.bodies[i].placement.position);
        EXPECT_EQ(one.bodies[i].placement.rotation.coeffs(),
                  same.bodies[i].placement.rotation.coeffs());
        moved += one.bodies[i].placement.position != other.bodies[i].placement.position;
    }
    EXPECT_GT(moved, 120);
}

TEST(Repeat, JitterStaysWithinItsBounds) {
    const Scene scene = scene_of(
        with_repeat(R"("count": [1000, 1, 1], "spacing": [0, 0, 0], "jitter": [0.5, 0, 2])"));
    Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
    for (const auto& body : scene.bodies) {
        low = low.cwiseMin(body.placement.position);
        high = high.cwiseMax(body.placement.position);
    }
    EXPECT_TRUE((low.array() >= Eigen::Array3d(-0.5, 0, -2)).all() &&
                (high.array() <= Eigen::Array3d(0.5, 0, 2)).all());
    EXPECT_GT(high.z() - low.z(), 3.9);
}

TEST(Repeat, MovesPositionsAndScriptsAlong) {
    const Scene scene =
        scene_of(R"({"bodies": [{"repeat": {"count": [2, 1, 1], "spacing": [10, 0, 0]}, "bodies": [
        {"shape": {"sphere": {"radius": 1}}, "motion": "kinematic", "position": [1, 2, 3],
         "script": {"keyframes": [{"time": 1, "position": [1, 5, 3]}]}}]}]})");
    EXPECT_EQ(scene.bodies[1].placement.position, Eigen::Vector3d(11, 2, 3));
    EXPECT_EQ(scene.bodies[1].script.keyframes[0].placement.position, Eigen::Vector3d(11, 5, 3));
    EXPECT_EQ(scene.bodies[1].name, "body_0002");
}

TEST(Repeat, RefusesWhatDoesNotFit) {
    const std::string at = "/bodies/0/repeat";
    expect_error(with_repeat(R"("count": [1000, 1001, 1])"), at, "at most 1000000");
    expect_error(with_repeat(R"("count": [1000000, 1000000, 1000000])"), at, "at most 1000000");
    expect_error(with_repeat(R"("count": [65536, 65536, 1])"), at, "4294967296");
    expect_error(with_repeat(R"("count": [2, 2, 2], "total": 9)"), at + "/total", "only 8 places");
    expect_error(with_repeat(R"("count": [2, 0, 2])"), at + "/count/1", "from 1");
    expect_error(with_repeat(R"("count": [2, 2])"), at + "/count", "a list of 3");
    expect_error(with_repeat(R"("spacing": [1, 1, 1])"), at, "\"count\" is missing");
    expect_error(with_repeat(R"("count": [2, 2, 2], "jitter": -1)"), at + "/jitter", "from 0");
    expect_error(with_repeat(R"("count": [2, 2, 2], "centred": [true, true, true])"),
                 at + "/centred", "did you mean \"centered\"?");
    expect_error(R"({"bodies": [{"repeat": {"count": [1, 1, 1]}, "bodies": []}]})",
                 "/bodies/0/bodies", "at least one body");
    expect_error(with_body(R"("weight": 1)"), "/bodies/0/weight", "unknown key");
}

}  // namespace plumb::test
