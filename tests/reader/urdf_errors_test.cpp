// SPDX-License-Identifier: MIT
/// URDF files that cannot be used: the sentence names the file, and the link or joint.
#include "robots.h"

namespace plumb::test {

TEST_F(Robots, RefuseWhatIsNoRobot) {
    expect_words(error_of_text("<robot name='r'><link name='a'></robot>"), "line 1: not good XML");
    expect_words(error_of_text("<urdf/>"), "no \"robot\" element");
    expect_words(error_of_text(""), "not good XML");
    expect_words(error_of(""), "No link elements");
    expect_words(error_of_text("<robot><link name='a'/></robot>"), "No name given for the robot");
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    expect_words(error_of_text(deep), "nested too deeply");
    try {
        read_scene(folder_ / "gone.urdf");
        ADD_FAILURE() << "no error";
    } catch (const SceneError& error) {
        expect_words(error.what(), "gone.urdf: there is no such file");
    }
}

TEST_F(Robots, RefuseWhatIsNoTree) {
    expect_words(error_of(link("a") + link("b")), "Two root links found: [a] and [b]");
    expect_words(error_of(link("a") + link("b") + link("c") + joint("continuous", "b", "c") +
                          joint("continuous", "c", "b")),
                 "link \"b\" is in a ring of joints");
    expect_words(error_of(link("a") + joint("continuous", "a", "a")), "No root link found");
    expect_words(error_of(link("a") + link("b") + link("c") + joint("continuous", "a", "b") +
                          joint("continuous", "a", "c") + joint("continuous", "b", "c")),
                 "link \"c\" is the child of two joints, \"ac\" and \"bc\"");
    expect_words(error_of(link("a") + joint("continuous", "a", "b")),
                 "child link [b] of joint [ab] not found");
    expect_words(error_of(link("b") + joint("continuous", "a", "b")),
                 "parent link [a] of joint [ab] not found");
    expect_words(error_of(link("a") + link("a")), "link 'a' is not unique");
}

TEST_F(Robots, RefuseUnsoundElements) {
    const std::string two = link("a") + link("b");
    expect_words(error_of(two + joint("springy", "a", "b")),
                 "Joint [ab] has no known type [springy]");
    expect_words(error_of(two + joint("revolute", "a", "b")), "Joint [ab] is of type REVOLUTE");
    expect_words(error_of(two + joint("revolute", "a", "b",
                                      R"(<limit lower="x" effort="1" velocity="1"/>)")),
                 "joint [ab]");
    expect_words(error_of(two + joint("revolute", "a", "b",
                                      R"(<limit lower="1" upper="0" effort="1" velocity="1"/>)")),
                 "joint \"ab\": its lower limit is above");
    expect_words(error_of(two + joint("continuous", "a", "b", R"(<axis xyz="0 0 0"/>)")),
                 "joint \"ab\": its axis is zero");
    expect_words(error_of(two + joint("continuous", "a", "b", R"(<dynamics damping="-1"/>)")),
                 "joint \"ab\": its damping must be 0 or above");
    expect_words(error_of("<link name='a'><inertial><mass value='1'/></inertial></link>"),
                 "Could not parse inertial element for Link [a]");
    expect_words(error_of(link("a", collision("<capsule radius='1'/>"))),
                 "Could not parse collision element for Link [a]");
    expect_words(error_of(link("a", collision("<sphere radius='0'/>"))),
                 "link \"a\": the radius of a sphere must be");
}

TEST_F(Robots, RefuseToMoveWhatHasNoMass) {
    const auto moving = [](const std::string& b) {
        return link("a") + b + joint("continuous", "a", "b");
    };
    expect_words(error_of(moving("<link name='b'/>")), "link \"b\" has no mass, so it cannot move");
    expect_words(error_of(moving("<link name='b'>" + inertial("0 0 0", "1", "0 0 0") + "</link>")),
                 "link \"b\": its inertia is missing or not positive");
    expect_words(error_of(moving("<link name='b'>" + inertial("1 1 3", "1", "0 0 0") + "</link>")),
                 "link \"b\": its inertia is of no body");
    expect_words(error_of(moving("<link name='b'>" + inertial("1 1 1", "-1", "0 0 0") + "</link>")),
                 "link \"b\": its mass must be 0, or a number");
    RobotOptions options;
    options.base = RobotBase::free;
    expect_words(error_of("<link name='w'/>" + link("a") + joint("continuous", "w", "a"), options),
                 "link \"w\", the root, has no mass, so it cannot be free");
}

TEST_F(Robots, RefusePositionsAndMotorsOfNoJoint) {
    const std::string arm = link("a") + link("b") + link("c") +
                            joint("revolute", "a", "b", kLimit) + joint("fixed", "b", "c");
    const auto starting = [&](const std::string& name, double position) {
        RobotOptions options;
        options.positions[name] = position;
        return error_of(arm, options);
    };
    expect_words(starting("ba", 1), "there is no joint \"ba\"; did you mean \"ab\"?");
    expect_words(starting("bc", 1), "joint \"bc\" neither turns nor slides");
    expect_words(starting("ab", 2.5), "joint \"ab\" cannot start at 2.5");
    RobotOptions options;
    options.motors["bc"] = {};
    expect_words(error_of(arm, options), "joint \"bc\" neither turns nor slides");
}

TEST_F(Robots, RefuseMimicsOfNothing) {
    const std::string links = link("a") + link("b") + link("c");
    const auto mimic = [](const std::string& of) { return "<mimic joint='" + of + "'/>"; };
    expect_words(error_of(links + joint("continuous", "a", "b", mimic("xy")) +
                          joint("continuous", "a", "c")),
                 "joint \"ab\" mimics \"xy\", which is no joint");
    expect_words(error_of(links + joint("continuous", "a", "b", mimic("ac")) +
                          joint("continuous", "a", "c", mimic("ab"))),
                 "mimics itself");
    RobotOptions options;
    options.positions["ab"] = 1;
    expect_words(
        error_of(links + joint("continuous", "a", "b", mimic("ac")) + joint("continuous", "a", "c"),
                 options),
        "joint \"ab\" mimics \"ac\", so its position cannot be chosen");
}

}  // namespace plumb::test
