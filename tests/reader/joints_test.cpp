// SPDX-License-Identifier: MIT
#include "joining.h"

namespace plumb::test {

namespace {

using Eigen::Vector3d;

std::string ball_joint(const std::string& bodies) {
    return with_joint(R"({"type": "ball", "anchor": [0, 0, 0], "bodies": )" + bodies + "}");
}

struct KindCase {
    const char* name;
    JointKind kind;
    bool axis, second_axis, anchor;  ///< which it needs
    std::vector<const char*> axes;   ///< that it leaves free
    bool beside;                     ///< whether "limits" may stand beside "type"
};

const std::vector<KindCase>& kinds() {
    using K = JointKind;
    static const std::vector<KindCase> list = {
        {"ball", K::ball, false, false, true, {"turn_x", "turn_y", "turn_z"}, false},
        {"point_on_line",
         K::point_on_line,
         true,
         false,
         true,
         {"x", "turn_x", "turn_y", "turn_z"},
         true},
        {"point_on_plane",
         K::point_on_plane,
         true,
         false,
         true,
         {"y", "z", "turn_x", "turn_y", "turn_z"},
         false},
        {"orientation", K::orientation, false, false, false, {"x", "y", "z"}, false},
        {"parallel", K::parallel, true, false, false, {"x", "y", "z", "turn_x"}, false},
        {"perpendicular",
         K::perpendicular,
         true,
         true,
         false,
         {"x", "y", "z", "turn_x", "turn_y"},
         false},
        {"fixed", K::fixed, false, false, true, {}, false},
        {"hinge", K::hinge, true, false, true, {"turn_x"}, true},
        {"universal", K::universal, true, true, true, {"turn_x", "turn_y"}, false},
        {"slider", K::slider, true, false, true, {"x"}, true},
        {"cylindrical", K::cylindrical, true, false, true, {"x", "turn_x"}, false},
        {"planar", K::planar, true, false, true, {"y", "z", "turn_x"}, false},
        {"distance", K::distance, false, false, true, {"x"}, true},
        {"cone_twist", K::cone_twist, true, false, true, {"twist", "swing"}, false},
        {"six_axis",
         K::six_axis,
         false,
         false,
         true,
         {"x", "y", "z", "turn_x", "turn_y", "turn_z"},
         false}};
    return list;
}

/// A joint of the kind with all that it needs but for one key, and with more keys.
std::string whole(const KindCase& k, const std::string& more = "", const std::string& but = "") {
    std::string text = std::string(R"({"type": ")") + k.name + R"(", "bodies": ["a", "b"])";
    const auto add = [&](bool wanted, const std::string& key, const std::string& value) {
        if (wanted && key != but) text += ", \"" + key + "\": " + value;
    };
    add(k.anchor, "anchor", "[1, 2, 3]");
    add(k.kind == JointKind::distance, "anchor_b", "[1, 2, 5]");
    add(k.axis, "axis", "[0, 0, 2]");
    add(k.second_axis, "second_axis", "[0, 3, 1]");
    return with_joint(text + (more.empty() ? "" : ", " + more) + "}");
}

}  // namespace

TEST(Joints, AreOfEveryKind) {
    for (const KindCase& k : kinds()) {
        const JointSpec joint = joint_of(whole(k));
        EXPECT_EQ(joint.kind, k.kind) << k.name;
        EXPECT_EQ(joint.name, "joint_1");
        EXPECT_EQ(joint.body_a, 0u);
        EXPECT_EQ(joint.body_b, 1u);
        // Without an anchor the first body's position is one.
        EXPECT_EQ(joint.anchor, k.anchor ? Vector3d(1, 2, 3) : Vector3d(0.5, 0, 0)) << k.name;
        EXPECT_EQ(joint.anchor_b.has_value(), k.kind == JointKind::distance) << k.name;
        const Vector3d x = k.axis ? Vector3d::UnitZ() : Vector3d::UnitX();
        EXPECT_TRUE((joint.frame * Vector3d::UnitX()).isApprox(x, 1e-15)) << k.name;
        if (k.second_axis) {
            EXPECT_TRUE((joint.frame * Vector3d::UnitY()).isApprox(Vector3d::UnitY(), 1e-15));
        }
    }
}

TEST(Joints, NeedWhatTheirKindNeeds) {
    for (const KindCase& k : kinds()) {
        std::vector<std::string> needs{};
        if (k.anchor) needs.emplace_back("anchor");
        if (k.axis) needs.emplace_back("axis");
        if (k.second_axis) needs.emplace_back("second_axis");
        if (k.kind == JointKind::distance) needs.emplace_back("anchor_b");
        for (const std::string& key : needs)
            expect_error(whole(k, "", key), "/joints/0",
                         "\"" + key + "\" is missing, which a joint of type " + k.name + " needs");
    }
}

TEST(Joints, RefuseAxesThatMeanNothingToTheirKind) {
    for (const KindCase& k : kinds()) {
        const bool none = k.kind == JointKind::ball || k.kind == JointKind::fixed ||
                          k.kind == JointKind::orientation || k.kind == JointKind::distance;
        if (!none) continue;
        for (const std::string key : {"axis", "second_axis"})
            expect_error(whole(k, "\"" + key + "\": [1, 0, 0]"), "/joints/0/" + key,
                         std::string("a joint of type ") + k.name + " cannot use \"" + key +
                             "\". Allowed: name, type, bodies, anchor");
    }
    for (const KindCase& k : kinds()) {
        if (k.kind != JointKind::six_axis)
            expect_error(whole(k, R"("locked": ["x"])"), "/joints/0/locked", "cannot use");
        if (k.kind != JointKind::distance)
            expect_error(whole(k, R"("anchor_b": [0, 0, 0])"), "/joints/0/anchor_b", "cannot use");
    }
}

TEST(Joints, TakeLimitsOnTheAxesThatTheyLeaveFree) {
    const std::vector<std::string> all = {"x",      "y",      "z",     "turn_x",
                                          "turn_y", "turn_z", "twist", "swing"};
    for (const KindCase& k : kinds()) {
        for (const std::string& axis : all) {
            const bool free = std::count(k.axes.begin(), k.axes.end(), axis) > 0;
            const std::string text = whole(k, R"("axes": {")" + axis + R"(": {"limits": [0, 3]}})");
            if (free) {
                const JointSpec joint = joint_of(text);
                EXPECT_EQ(joint.axes[axis_named(axis)].upper, 3) << k.name << " " << axis;
            } else {
                expect_error(
                    text, "/joints/0/axes/" + axis,
                    std::string("a joint of type ") + k.name + " is not free in \"" + axis + "\"");
            }
        }
        const std::string beside = whole(k, R"("limits": [0, 3])");
        if (k.beside) {
            EXPECT_EQ(joint_of(beside).axes[axis_named(k.axes.front())].upper, 3) << k.name;
        } else {
            expect_error(beside, "/joints/0/limits", "cannot use \"limits\"");
        }
    }
}

TEST(Joints, TakeStrengthsOfWhatTheyLock) {
    for (const KindCase& k : kinds()) {
        const std::size_t turns = std::count_if(k.axes.begin(), k.axes.end(), [](const char* axis) {
            return axis_named(axis) >= kTurnX;
        });
        const bool six = k.kind == JointKind::six_axis;
        const bool rotations =
            six || (turns < 3 && k.kind != JointKind::distance && k.kind != JointKind::cone_twist);
        const std::string force = whole(k, R"("compliance": 0.5, "breaking_force": 7)"),
                          torque = whole(k, R"("angular_compliance": 0.25, "breaking_torque": 8)");
        if (k.anchor) {
            EXPECT_EQ(joint_of(force).compliance, 0.5) << k.name;
            EXPECT_EQ(joint_of(force).breaking_force, 7) << k.name;
        } else {
            expect_error(force, "/joints/0/breaking_force", "cannot use");
        }
        if (rotations) {
            EXPECT_EQ(joint_of(torque).angular_compliance, 0.25) << k.name;
            EXPECT_EQ(joint_of(torque).breaking_torque, 8) << k.name;
        } else {
            expect_error(torque, "/joints/0/angular_compliance", "cannot use");
        }
    }
}

TEST(Joints, FillAllMembers) {
    const Scene scene = scene_of(with_joint(R"(
        {"name": "j", "type": "ball", "bodies": ["a", "b"], "anchor": [1, 2, 3], "collide": true},
        {"type": "ball", "bodies": ["b"], "anchor": [0, 0, 0]})"));
    ASSERT_EQ(scene.joints.size(), 2u);
    EXPECT_EQ(scene.joints[0].name, "j");
    EXPECT_EQ(scene.joints[0].body_a, 0u);
    EXPECT_EQ(scene.joints[0].body_b, 1u);
    EXPECT_EQ(scene.joints[0].anchor, Vector3d(1, 2, 3));
    EXPECT_TRUE(scene.joints[0].collide);
    EXPECT_TRUE(std::isinf(scene.joints[0].breaking_force));
    EXPECT_EQ(scene.joints[1].name, "joint_2");
    EXPECT_EQ(scene.joints[1].body_a, 1u);
    EXPECT_EQ(scene.joints[1].body_b, kNoIndex);
}

TEST(Joints, RefuseBodiesThatCannotBeJoined) {
    const std::string at = "/joints/0/bodies";
    expect_error(ball_joint(R"(["a", "c"])"), at + "/1", "there is no body named \"c\"");
    expect_error(ball_joint(R"(["a", "a"])"), at, "itself");
    expect_error(ball_joint(R"(["f", "k"])"), at, "at least one");
    expect_error(ball_joint(R"(["f"])"), at, "at least one");
    expect_error(ball_joint("[]"), at, "a list of two bodies");
    EXPECT_EQ(scene_of(ball_joint(R"(["a", "f"])")).joints.size(), 1u);
}

TEST(Joints, RefuseWhatIsMissingOrUnknown) {
    expect_error(with_joint(R"({"bodies": ["a", "b"]})"), "/joints/0", "\"type\" is missing");
    expect_error(with_joint(R"({"type": "hinge", "anchor": [0,0,0]})"), "/joints/0",
                 "\"bodies\" is missing");
    expect_error(with_joint(R"({"type": "hinje", "bodies": ["a"]})"), "/joints/0/type",
                 "did you mean \"hinge\"?");
    expect_error(with_joint(R"({"type": "ball", "bodies": ["a"], "anchr": [0,0,0]})"),
                 "/joints/0/anchr", "did you mean \"anchor\"?");
    expect_error(with_joint(R"({"type": "ball", "bodies": ["a"], "anchor": [0,0,0], "name": "j"},
                               {"type": "ball", "bodies": ["b"], "anchor": [0,0,0], "name": "j"})"),
                 "/joints/1", "already a joint named \"j\"");
}

TEST(Joints, HaveFramesThatAreTheirAxes) {
    // The frame's x axis is the axis, and the rest of it is right-handed, whatever the direction.
    for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0),
                                 Vector3d(0, -1, 0), Vector3d(0, 0, -4), Vector3d(1, -2, 3)}) {
        std::ostringstream text;
        text << R"("axis": [)" << axis.x() << ", " << axis.y() << ", " << axis.z() << "]";
        const JointSpec joint = joint_of(with_joint(
            R"({"type": "hinge", "bodies": ["a"], "anchor": [0, 0, 0], )" + text.str() + "}"));
        EXPECT_NEAR(joint.frame.norm(), 1, 1e-15);
        EXPECT_TRUE((joint.frame * Vector3d::UnitX()).isApprox(axis.normalized(), 1e-15));
    }
    // What of the second axis is not perpendicular to the first does not count.
    const JointSpec joint = joint_of(
        with_joint(R"({"type": "hinge", "bodies": ["a"], "anchor": [0, 0, 0], "axis": [0, 2, 0],
                       "second_axis": [3, 5, 0]})"));
    EXPECT_TRUE((joint.frame * Vector3d::UnitY()).isApprox(Vector3d::UnitX(), 1e-15));
    EXPECT_TRUE((joint.frame * Vector3d::UnitZ()).isApprox(-Vector3d::UnitZ(), 1e-15));
}

TEST(Joints, RefuseAxesWithoutDirection) {
    const auto hinge = [](const std::string& keys) {
        return with_joint(R"({"type": "hinge", "bodies": ["a"], "anchor": [0, 0, 0], )" + keys +
                          "}");
    };
    expect_error(hinge(R"("axis": [0, 0, 0])"), "/joints/0/axis", "the axis is zero");
    expect_error(hinge(R"("axis": [0, 0])"), "/joints/0/axis", "a list of 3 numbers");
    expect_error(hinge(R"("axis": [1, 0, 0], "second_axis": [0, 0, 0])"), "/joints/0/second_axis",
                 "the axis is zero");
    expect_error(hinge(R"("axis": [1, 2, 0], "second_axis": [-2, -4, 0])"), "/joints/0/second_axis",
                 "is parallel to \"axis\"");
    expect_error(with_joint(R"({"type": "six_axis", "bodies": ["a"], "anchor": [0, 0, 0],
                                "second_axis": [1, 0, 0]})"),
                 "/joints/0/second_axis", "needs an \"axis\"");
}

TEST(Joints, OfSixAxesLockWhatIsListed) {
    const auto six = [](const std::string& keys) {
        return with_joint(R"({"type": "six_axis", "bodies": ["a"], "anchor": [0, 0, 0], )" + keys +
                          "}");
    };
    const JointSpec joint =
        joint_of(six(R"("locked": ["z", "turn_x"], "axes": {"x": {"friction": 2}})"));
    EXPECT_EQ(joint.locked, (std::array<bool, 6>{false, false, true, true, false, false}));
    EXPECT_EQ(joint.axes[kAlongX].friction, 2);
    expect_error(six(R"("locked": ["w"])"), "/joints/0/locked/0", "Allowed: x, y, z, turn_x");
    expect_error(six(R"("locked": ["z", "x", "z"])"), "/joints/0/locked/2", "twice");
    expect_error(six(R"("locked": "x")"), "/joints/0/locked", "a list of axes");
    expect_error(six(R"("locked": ["z"], "axes": {"z": {"friction": 2}})"), "/joints/0/axes/z",
                 "\"locked\" has \"z\"");
    expect_error(six(R"("axes": {"turnx": {}})"), "/joints/0/axes/turnx",
                 "did you mean \"turn_x\"?");
}

}  // namespace plumb::test
