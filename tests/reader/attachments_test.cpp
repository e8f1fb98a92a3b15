// SPDX-License-Identifier: MIT
/// "attach" and "links".
#include "reading.h"
#include "scene/link_faults.h"

namespace plumb::test {

namespace {

/// A scene with a pole, a crate, and a rope of points at x = 0, 1, 2, which is attached somewhere.
std::string attached(const std::string& attachments, const std::string& more = "") {
    return R"({"bodies": [{"name": "pole", "motion": "fixed", "shape": {"sphere": {"radius": 1}}, "position": [0, 1, 0]},
                          {"name": "crate", "shape": {"sphere": {"radius": 1}}, "position": [5, 0, 0]}],
               "deformables": [{"name": "string", "kind": "rope",
                                "shape": {"line": {"from": [0, 0, 0], "to": [2, 0, 0], "segments": 2}},
                                "attach": [)" +
           attachments + "]}]" + more + "}";
}

std::string linked(const std::string& keys) {
    return attached("", ", \"links\": [{" + keys + "}]");
}

std::vector<std::uint32_t> picked(const std::string& keys) {
    const Scene scene = scene_of(attached("{" + keys + "}"));
    return scene.attachments.at(0).points;
}

LinkSpec link_of(const std::string& keys) { return scene_of(linked(keys)).links.at(0); }

using Points = std::vector<std::uint32_t>;
const std::string kPlace = "/deformables/0/attach/0";

}  // namespace

TEST(Attachments, PickPointsInFourWays) {
    EXPECT_EQ(picked(R"("points": [2, 0])"), (Points{2, 0}));
    EXPECT_EQ(picked(R"("near": {"point": [1, 0, 0], "radius": 0.1})"), Points{1});
    EXPECT_EQ(picked(R"("box": {"centre": [2, 0, 0], "half_extents": [1, 1, 1]})"), (Points{1, 2}));
    EXPECT_EQ(picked(R"("all": true)"), (Points{0, 1, 2}));
}

TEST(Attachments, AreToABodyOrTheWorld) {
    const Scene scene = scene_of(attached(R"({"points": [0], "to": "crate", "compliance": 1e-4},
                                             {"points": [2]})"));
    ASSERT_EQ(scene.attachments.size(), 2u);
    EXPECT_EQ(scene.attachments[0].deformable, 0u);
    EXPECT_EQ(scene.attachments[0].body, 1u);
    EXPECT_EQ(scene.attachments[0].compliance, 1e-4);
    EXPECT_EQ(scene.attachments[1].body, kNoIndex);
    EXPECT_EQ(scene.attachments[1].compliance, 0);
}

TEST(Attachments, AreInTheWorldFrame) {
    const Scene scene = scene_of(R"({"deformables": [{"kind": "rope", "position": [0, 3, 0],
        "shape": {"line": {"from": [0, 0, 0], "to": [2, 0, 0], "segments": 2}},
        "attach": [{"near": {"point": [2, 3, 0], "radius": 0.1}}]}]})");
    EXPECT_EQ(scene.attachments[0].points, Points{2});
}

TEST(Attachments, SayHowFarTheNearestPointIs) {
    expect_error(
        attached(R"({"near": {"point": [4, 0, 0], "radius": 0.5}})"), kPlace + "/near",
        "there is no point within the radius; the nearest, point 2, is 1.5 m away from it");
    expect_error(attached(R"({"box": {"centre": [1, 2, 0], "half_extents": [1, 1, 1]}})"),
                 kPlace + "/box",
                 "there is no point in the box; the nearest, point 0, is 1 m away");
}

TEST(Attachments, RefuseWhatIsNotThere) {
    expect_error(attached(R"({"points": [3]})"), kPlace + "/points/0",
                 "there is no point 3; \"string\" has 3, numbered from 0");
    expect_error(attached(R"({"points": [1, 1]})"), kPlace + "/points/1",
                 "point 1 stands in the list twice");
    expect_error(attached(R"({"points": []})"), kPlace + "/points", "at least one number");
    expect_error(attached(R"({"all": false})"), kPlace + "/all", "must be true, or left out");
    expect_error(attached(R"({"points": [0], "to": "crat"})"), kPlace + "/to",
                 "did you mean \"crate\"?");
    expect_error(attached(R"({"to": "crate"})"), kPlace, "must have one of \"points\"");
    expect_error(attached(R"({"all": true, "points": [1]})"), kPlace, "must have one of");
    expect_error(attached(R"({"points": [0], "compliance": -1})"), kPlace + "/compliance",
                 "must be a number");
    expect_error(R"({"deformables": [{"kind": "rope", "shape": {"line": {"from": [0, 0, 0],
                     "to": [2, 0, 0]}}, "attach": {}}]})",
                 "/deformables/0/attach", "a list of attachments");
}

TEST(Links, TieAnyTwoPoints) {
    const LinkSpec whole = link_of(R"("a": {"deformable": "string", "point": 2},
        "b": {"body": "crate", "position": [4, 0, 0]}, "length": 1.5, "compliance": 0.1, "damping": 3)");
    EXPECT_EQ(whole.a.deformable, 0u);
    EXPECT_EQ(whole.a.point, 2u);
    EXPECT_EQ(whole.a.body, kNoIndex);
    EXPECT_EQ(whole.b.body, 1u);
    EXPECT_EQ(whole.b.deformable, kNoIndex);
    EXPECT_EQ(whole.b.position, Eigen::Vector3d(4, 0, 0));
    EXPECT_EQ(whole.shortest, 1.5);
    EXPECT_EQ(whole.longest, 1.5);
    EXPECT_EQ(whole.compliance, 0.1);
    EXPECT_EQ(whole.damping, 3);

    const LinkSpec short_one = link_of(R"("a": {"position": [0, 4, 0]}, "b": {"body": "crate"})");
    EXPECT_EQ(short_one.a.body, kNoIndex);
    EXPECT_EQ(short_one.b.position, Eigen::Vector3d(5, 0, 0));
    EXPECT_FALSE(short_one.shortest || short_one.longest);

    const LinkSpec rope = link_of(R"("a": {"deformable": "string", "near": [1.2, 3, 0]},
        "b": {"deformable": "string", "point": 0}, "limits": [null, 2])");
    EXPECT_EQ(rope.a.point, 1u);
    EXPECT_FALSE(rope.shortest);
    EXPECT_EQ(rope.longest, 2);
}

TEST(Links, RefuseWhatIsNotThere) {
    const std::string end = R"("a": {"deformable": "string", "point": 0}, )", place = "/links/0";
    expect_error(linked(R"("a": {"deformable": "sting", "point": 0}, "b": {"body": "crate"})"),
                 place + "/a/deformable", "did you mean \"string\"?");
    expect_error(linked(end + R"("b": {"deformable": "string", "point": 7})"), place + "/b/point",
                 "there is no point 7; \"string\" has 3");
    expect_error(linked(end + R"("b": {"body": "pol"})"), place + "/b/body",
                 "did you mean \"pole\"?");
    expect_error(linked(end + R"("b": {})"), place + "/b",
                 "must have \"deformable\", \"body\" or \"position\"");
    expect_error(linked(end + R"("b": {"deformable": "string"})"), place + "/b",
                 "must have either \"point\" or \"near\"");
    expect_error(linked(end + R"("b": {"deformable": "string", "point": 1, "body": "pole"})"),
                 place + "/b/body", "has no \"body\"");
    expect_error(linked(end + R"("b": {"body": "pole", "point": 1})"), place + "/b/point",
                 "needs a \"deformable\" beside it");
    expect_error(linked(R"("a": {"position": [0, 0, 0]})"), place, "\"b\" is missing");
    expect_error(R"({"links": {}})", "/links", "a list of links");
}

TEST(Links, RefuseWhatCannotBe) {
    const std::string ends = R"("a": {"deformable": "string", "point": 0}, "b": {"body": "crate"})",
                      place = "/links/0";
    expect_error(linked(ends + R"(, "limits": [2, 1])"), place + "/limits",
                 "the shortest length is above the longest");
    expect_error(linked(ends + R"(, "limits": [null, null])"), place + "/limits",
                 "at least one of the two limits");
    expect_error(linked(ends + R"(, "length": 0)"), place + "/length", "must be a number above 0");
    expect_error(linked(ends + R"(, "length": 1, "limits": [0, 1])"), place,
                 "either \"length\" or \"limits\"");
    expect_error(linked(ends + R"(, "damping": -1)"), place + "/damping", "must be a number");
    expect_error(linked(R"("a": {"position": [0, 0, 0]}, "b": {"position": [1, 0, 0]})"), place,
                 "both of its points are of the world");
    expect_error(linked(R"("a": {"body": "crate"}, "b": {"body": "crate", "position": [1, 0, 0]})"),
                 place, "both of its points are of one body");
    expect_error(
        linked(
            R"("a": {"deformable": "string", "point": 1}, "b": {"deformable": "string", "point": 1})"),
        place, "it links a point to itself");
    expect_error(
        linked(R"("a": {"deformable": "string", "point": 1}, "b": {"position": [1, 0, 0]})"), place,
        "its two points lie at one place");
}

}  // namespace plumb::test
