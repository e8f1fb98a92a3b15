// SPDX-License-Identifier: MIT
/// Entries {"chain": …} and {"mobile": …}.
#include <numbers>

#include "reading.h"

namespace plumb::test {

namespace {

using Eigen::Vector3d;

std::string with_chain(const std::string& keys) {
    return R"({"bodies": [{"chain": {)" + keys + "}}]}";
}
std::string with_mobile(const std::string& keys) {
    return R"({"bodies": [{"mobile": {)" + keys + "}}]}";
}
const std::string kFour = R"("links": 4, "from": [1, 2, 3], "to": [4, 6, 3], "radius": 0.25)";

/// The distance from a joint's anchor to a point of a body, given in the body's frame [m].
double gap(const Scene& scene, const JointSpec& joint, std::uint32_t body, const Vector3d& point) {
    const Placement& placement = scene.bodies[body].placement;
    return (placement.position + placement.rotation * point - joint.anchor).norm();
}

}  // namespace

TEST(Chain, LinksTouchTheirJoints) {
    const Scene scene = scene_of(with_chain(kFour));
    ASSERT_EQ(scene.bodies.size(), 4u);
    ASSERT_EQ(scene.joints.size(), 4u);
    ASSERT_EQ(scene.geometries.size(), 1u);
    const Geometry& capsule = scene.geometries[0];
    EXPECT_EQ(capsule.kind, ShapeKind::capsule);
    EXPECT_EQ(capsule.radius, 0.25);
    const Vector3d tip(0, capsule.half_height + capsule.radius, 0);
    EXPECT_NEAR(tip.y(), 5.0 / 4 / 2, 1e-15);
    for (std::uint32_t i = 0; i < 4; ++i) {
        const JointSpec& joint = scene.joints[i];
        EXPECT_EQ(joint.kind, JointKind::ball);
        EXPECT_EQ(joint.body_a, i);
        EXPECT_EQ(joint.body_b, i == 0 ? kNoIndex : i - 1);
        EXPECT_LE(gap(scene, joint, i, -tip), 1e-14);
        if (i > 0) {
            EXPECT_LE(gap(scene, joint, i - 1, tip), 1e-14);
        }
    }
    EXPECT_EQ(scene.joints[0].anchor, Vector3d(1, 2, 3));
    EXPECT_EQ(scene.bodies[3].name, "chain_0004");
    EXPECT_EQ(scene.joints[3].name, "chain_0004");
}

TEST(Chain, LinksMayBeJoinedToOthers) {
    const Scene scene = scene_of(
        R"({"materials": {"iron": {}}, "bodies": [{"chain": {"name": "c", "material": "iron",
            "color": "#010203", )" +
        kFour + R"(}}], "joints": [{"name": "more", "type": "fixed", "bodies": ["c_0002"],
            "anchor": [0, 0, 0]}]})");
    ASSERT_EQ(scene.joints.size(), 5u);
    EXPECT_EQ(scene.joints[4].name, "more");
    EXPECT_EQ(scene.joints[4].body_a, 1u);
    EXPECT_EQ(scene.bodies[2].material, 1u);
    EXPECT_EQ(scene.bodies[2].color, 0x010203u);
}

TEST(Chain, RefusesWhatDoesNotFit) {
    const std::string at = "/bodies/0/chain";
    expect_error(with_chain(R"("links": 4)"), at, "\"from\" is missing");
    expect_error(with_chain(R"("links": 0)"), at + "/links", "from 1");
    expect_error(with_chain(R"("links": 4, "from": [0, 0, 0], "to": [0, 0, 0], "radius": 1)"), at,
                 "too near");
    expect_error(with_chain(R"("links": 4, "from": [0, 0, 0], "to": [4, 0, 0], "radius": 0.5)"),
                 at + "/radius", "half of a link's length, which is 1 m");
    expect_error(with_chain(R"("lincs": 4)"), at + "/lincs", "did you mean \"links\"?");
    expect_error(with_chain(R"("material": "iron")"), at, "\"links\" is missing");
    expect_error(R"({"bodies": [{"chain": {}, "repeat": {}}]})", "/bodies/0/chain", "unknown key");
    // Names of links' joints are names of joints.
    expect_error(R"({"bodies": [{"chain": {)" + kFour +
                     R"(}}], "joints": [{"name": "chain_0001", "type": "fixed",
                     "bodies": ["chain_0003"], "anchor": [0, 0, 0]}]})",
                 "/joints/0", "already a joint named");
}

TEST(Mobile, RodsHangFromTheEndsOfTheirParents) {
    const Scene scene = scene_of(with_mobile(R"("levels": 4, "position": [1, 2, 3])"));
    ASSERT_EQ(scene.bodies.size(), 15u);
    ASSERT_EQ(scene.joints.size(), 15u);
    ASSERT_EQ(scene.geometries.size(), 4u);
    EXPECT_NEAR(scene.geometries[0].half_extents.x(), 0.3 * std::pow(1.25, 3), 1e-15);
    EXPECT_EQ(scene.geometries[3].half_extents, Vector3d(0.3, 0.05, 0.05));
    EXPECT_EQ(scene.joints[0].anchor, Vector3d(1, 2, 3));
    EXPECT_EQ(scene.joints[0].body_b, kNoIndex);
    for (std::uint32_t n = 0; n < 15; ++n) {
        const JointSpec& joint = scene.joints[n];
        EXPECT_EQ(joint.body_a, n);
        EXPECT_LE(gap(scene, joint, n, Vector3d(0, 0.25, 0)), 1e-15);
        if (n == 0) continue;
        EXPECT_EQ(joint.body_b, (n - 1) / 2);
        const double a = scene.geometries[scene.bodies[joint.body_b].geometry].half_extents.x();
        const double side = n % 2 == 1 ? -a : a;
        EXPECT_LE(gap(scene, joint, joint.body_b, Vector3d(side, -0.25, 0)), 1e-14) << n;
    }
    // A quarter turn about y at odd levels.
    for (std::uint32_t n = 0; n < 15; ++n) {
        const bool odd = (n >= 1 && n <= 2) || n >= 7;
        EXPECT_NEAR(Eigen::AngleAxisd(scene.bodies[n].placement.rotation).angle(),
                    odd ? std::numbers::pi / 2 : 0, 1e-15);
        EXPECT_EQ(scene.bodies[n].mask, 0u);
    }
}

TEST(Mobile, SpinsByItsSeed) {
    const Scene scene = scene_of(with_mobile(R"("levels": 8, "seed": 3)"));
    ASSERT_EQ(scene.bodies.size(), 255u);
    double low = 0, high = 0;
    for (const BodySpec& body : scene.bodies) {
        EXPECT_EQ(body.angular_velocity.x(), 0);
        EXPECT_EQ(body.angular_velocity.z(), 0);
        low = std::min(low, body.angular_velocity.y());
        high = std::max(high, body.angular_velocity.y());
    }
    EXPECT_GE(low, -0.5);
    EXPECT_LT(low, -0.45);
    EXPECT_LE(high, 0.5);
    EXPECT_GT(high, 0.45);
    const auto speed = [](const std::string& keys) {
        return scene_of(with_mobile(keys)).bodies[0].angular_velocity.y();
    };
    EXPECT_EQ(speed(R"("levels": 2, "seed": 3)"), scene.bodies[0].angular_velocity.y());
    EXPECT_NE(speed(R"("levels": 2, "seed": 4)"), scene.bodies[0].angular_velocity.y());
    EXPECT_EQ(speed(R"("levels": 2, "spin": 0)"), 0);
}

TEST(Mobile, RefusesWhatDoesNotFit) {
    const std::string at = "/bodies/0/mobile";
    expect_error(with_mobile(""), at, "\"levels\" is missing");
    expect_error(with_mobile(R"("levels": 20)"), at + "/levels", "from 1 to 19");
    expect_error(with_mobile(R"("levels": 2, "spin": -1)"), at + "/spin", "from 0");
    expect_error(with_mobile(R"("levels": 2, "material": "iron")"), at + "/material",
                 "no material named");
    expect_error(R"({"bodies": [{"mobile": {"levels": 2}, "mass": 1}]})", "/bodies/0/mass",
                 "unknown key");
}

}  // namespace plumb::test
