// SPDX-License-Identifier: MIT
#include "joining.h"

namespace plumb::test {

namespace {

/// A scene with a joint of several kinds each, named by them, and couplings.
std::string with_coupling(const std::string& couplings) {
    const auto joint = [](const std::string& name, const std::string& keys) {
        return R"({"name": ")" + name + R"(", "bodies": ["a", "b"], "anchor": [0, 0, 0], )" + keys +
               "}";
    };
    const std::string axis = R"("axis": [0, 0, 1])", far = R"("anchor_b": [0, 1, 0])";
    return with_joint(
        joint("hinge", R"("type": "hinge", )" + axis) + "," +
            joint("slider", R"("type": "slider", )" + axis) + "," +
            joint("line", R"("type": "point_on_line", )" + axis) + "," +
            joint("sleeve", R"("type": "cylindrical", )" + axis) + "," +
            joint("cone", R"("type": "cone_twist", )" + axis) + "," +
            joint("fixed", R"("type": "fixed")") + "," +
            joint("rod", R"("type": "distance", )" + far) + "," +
            joint("rope", R"("type": "distance", "limits": [0, 2], )" + far) + "," +
            joint("six",
                  R"("type": "six_axis", "locked": ["x", "y", "turn_x", "turn_y", "turn_z"])"),
        R"(, "couplings": [)" + couplings + "]");
}

std::string coupling(const std::string& a, const std::string& b, const std::string& more = "") {
    return with_coupling(R"({"joints": [")" + a + "\", \"" + b + R"("], "ratio": 2)" + more + "}");
}

CouplingSpec coupling_of(const std::string& text) {
    const Scene scene = scene_of(text);
    EXPECT_EQ(scene.couplings.size(), 1u);
    return scene.couplings.at(0);
}

}  // namespace

TEST(Couplings, TieTheOneFreeAxisOfEachJoint) {
    const CouplingSpec rack = coupling_of(coupling("hinge", "slider"));
    EXPECT_EQ(rack.name, "coupling_1");
    EXPECT_EQ(rack.joint_a, 0u);
    EXPECT_EQ(rack.joint_b, 1u);
    EXPECT_EQ(rack.axis_a, kTurnX);
    EXPECT_EQ(rack.axis_b, kAlongX);
    EXPECT_EQ(rack.ratio, 2);
    EXPECT_FALSE(rack.offset.has_value());
    EXPECT_EQ(coupling_of(coupling("hinge", "line")).axis_b, kAlongX);
    EXPECT_EQ(coupling_of(coupling("hinge", "rope")).axis_b, kAlongX);
    EXPECT_EQ(coupling_of(coupling("hinge", "six")).axis_b, kAlongZ);
}

TEST(Couplings, TieTheAxesThatAreNamed) {
    const CouplingSpec screw =
        coupling_of(coupling("sleeve", "sleeve", R"(, "axes": ["turn_x", "x"], "offset": 0.5)"));
    EXPECT_EQ(screw.axis_a, kTurnX);
    EXPECT_EQ(screw.axis_b, kAlongX);
    EXPECT_EQ(screw.offset, 0.5);
    const CouplingSpec twist =
        coupling_of(coupling("hinge", "cone", R"(, "axes": ["turn_x", "twist"], "name": "c")"));
    EXPECT_EQ(twist.axis_b, kTurnX);
    EXPECT_EQ(twist.name, "c");
}

TEST(Couplings, RefuseAxesThatCannotBeTied) {
    const std::string at = "/couplings/0/joints";
    expect_error(coupling("hinge", "sleeve"), at + "/1",
                 "joint \"sleeve\" of type cylindrical is free in several axes; name one for each "
                 "joint in \"axes\". Allowed: x, turn_x");
    expect_error(coupling("fixed", "hinge"), at + "/0", "no free axis");
    expect_error(coupling("hinge", "rod"), at + "/1", "no free axis");
    expect_error(coupling("hinge", "hinge"), at, "cannot be coupled to itself");
    const std::string axes = "/couplings/0/axes";
    expect_error(coupling("hinge", "slider", R"(, "axes": ["turn_x", "y"])"), axes + "/1",
                 "joint \"slider\" of type slider is not free in \"y\"");
    expect_error(coupling("hinge", "cone", R"(, "axes": ["turn_x", "twst"])"), axes + "/1",
                 "did you mean \"twist\"?");
    expect_error(coupling("hinge", "six", R"(, "axes": ["turn_x", "x"])"), axes + "/1",
                 "not free in \"x\"");
    expect_error(coupling("hinge", "rod", R"(, "axes": ["turn_x", "x"])"), axes + "/1",
                 "no free axis");
    expect_error(coupling("hinge", "slider", R"(, "axes": ["turn_x"])"), axes, "a list of 2");
}

TEST(Couplings, RefuseWhatIsMissingOrUnknown) {
    expect_error(with_coupling(R"({"joints": ["hinge", "slider"]})"), "/couplings/0",
                 "\"ratio\" is missing");
    expect_error(with_coupling(R"({"ratio": 1})"), "/couplings/0", "\"joints\" is missing");
    expect_error(with_coupling(R"({"joints": ["hinge", "slider"], "ratio": 0})"),
                 "/couplings/0/ratio", "must not be 0");
    expect_error(coupling("hinge", "slyder"), "/couplings/0/joints/1", "did you mean \"slider\"?");
    expect_error(with_coupling(R"({"joints": ["hinge"], "ratio": 1})"), "/couplings/0/joints",
                 "a list of 2 names of joints");
    expect_error(coupling("hinge", "slider", R"(, "ofset": 1)"), "/couplings/0/ofset",
                 "did you mean \"offset\"?");
    const std::string same = R"({"name": "c", "joints": ["hinge", "slider"], "ratio": 1})";
    expect_error(with_coupling(same + "," + same), "/couplings/1", "already a coupling named");
}

}  // namespace plumb::test
