// SPDX-License-Identifier: MIT
/// Faults that a file cannot have, for its reader refuses them before, but a program's scene can.
#include "scene/deformable_faults.h"

#include "scene/link_faults.h"

#include <gtest/gtest.h>
#include <limits>

namespace plumb::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

DeformableSpec cloth() {
    DeformableSpec spec;
    spec.name = "sheet";
    spec.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
    spec.triangles = {{0, 1, 2}};
    return spec;
}

Scene scene_of_cloth() {
    Scene scene;
    scene.deformables.push_back(cloth());
    scene.bodies.resize(2);
    return scene;
}

template <class Change>
void expect_fault(const std::string& place, const std::string& sentence, Change change) {
    DeformableSpec spec = cloth();
    change(spec);
    const auto fault = deformable_fault(spec, 1);
    ASSERT_TRUE(fault) << place;
    EXPECT_EQ(fault->place, place);
    EXPECT_NE(fault->sentence.find(sentence), std::string::npos) << fault->sentence;
}

LinkSpec link() {
    LinkSpec link;
    link.a.deformable = 0;
    link.b.body = 1;
    link.b.position = {1, 2, 3};
    return link;
}

template <class Change>
void expect_link_fault(const std::string& place, const std::string& sentence, Change change) {
    LinkSpec spec = link();
    change(spec);
    const auto fault = link_fault(scene_of_cloth(), spec);
    ASSERT_TRUE(fault) << place;
    EXPECT_EQ(fault->place, place);
    EXPECT_NE(fault->sentence.find(sentence), std::string::npos) << fault->sentence;
}

}  // namespace

TEST(DeformableFaults, GoodOnesHaveNone) {
    EXPECT_FALSE(deformable_fault(cloth(), 1));
    EXPECT_FALSE(link_fault(scene_of_cloth(), link()));
    EXPECT_FALSE(attachment_fault(scene_of_cloth(), {0, {2, 0}, 1, 0.5}));
}

TEST(DeformableFaults, OfPoints) {
    expect_fault("/points/1", "point 1 is not finite", [](auto& d) { d.points[1].y() = kNan; });
    expect_fault("/points/2", "point 2 lies further from the origin",
                 [](auto& d) { d.points[2].x() = 1e10; });
}

TEST(DeformableFaults, OfNumbers) {
    using D = DeformableSpec;
    const auto wrong = [](const char* place, auto change) {
        expect_fault(place, "must be", change);
    };
    wrong("/thickness", [](D& d) { d.thickness = kNan; });
    wrong("/thickness", [](D& d) { d.thickness = 0; });
    wrong("/young", [](D& d) { d.elasticity.youngs_modulus = 0; });
    wrong("/poisson", [](D& d) { d.elasticity.poissons_ratio = 1; });
    wrong("/poisson", [](D& d) { d.elasticity.poissons_ratio = kNan; });
    wrong("/bending", [](D& d) { d.elasticity.bending_stiffness = -1; });
    wrong("/damping", [](D& d) { d.elasticity.damping = kNan; });
    wrong("/volume_ratio", [](D& d) { d.volume_ratio = 0; });
    wrong("/pressure", [](D& d) { d.pressure = kNan; });
    wrong("/drag", [](D& d) { d.drag = -1; });
    wrong("/skin_drag", [](D& d) { d.skin_drag = kNan; });
    wrong("/radius", [](D& d) { d.radius = -1; });
    wrong("/mass", [](D& d) { d.mass = 0; });
    wrong("/tearing_strain", [](D& d) { d.tearing_strain = kNan; });
    wrong("/velocity", [](D& d) { d.velocity.x() = kNan; });
    expect_fault("/material", "there is no material 1", [](D& d) { d.material = 1; });
}

TEST(DeformableFaults, OfElementsOfOtherKinds) {
    expect_fault("/segments", "a cloth has no segments", [](auto& d) { d.segments = {{0, 1}}; });
    expect_fault("/tetrahedra", "a cloth has no tetrahedra", [](auto& d) {
        d.tetrahedra = {{0, 1, 2, 0}};
    });
    expect_fault("/triangles", "a rope has no triangles",
                 [](auto& d) { d.kind = DeformableKind::rope; });
    expect_fault("/kind", "there is no such kind",
                 [](auto& d) { d.kind = static_cast<DeformableKind>(9); });
}

TEST(DeformableFaults, OfABalloonThatIsTurnedInsideOut) {
    expect_fault("/triangles", "the balloon is turned inside out", [](auto& d) {
        d.kind = DeformableKind::balloon;
        d.points.push_back({0, 1, 0});
        d.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    });
}

TEST(DeformableFaults, OfLinks) {
    using L = LinkSpec;
    expect_link_fault("/a/deformable", "there is no deformable number 3",
                      [](L& l) { l.a.deformable = 3; });
    expect_link_fault("/a/point", "there is no point 3; \"sheet\" has 3",
                      [](L& l) { l.a.point = 3; });
    expect_link_fault("/b/body", "there is no body number 2", [](L& l) { l.b.body = 2; });
    expect_link_fault("/a", "either a deformable or a body", [](L& l) { l.a.body = 0; });
    expect_link_fault("/b/position", "must be finite", [](L& l) { l.b.position.z() = kNan; });
    expect_link_fault("/compliance", "from 0 to 1e15", [](L& l) { l.compliance = kNan; });
    expect_link_fault("/damping", "from 0 to 1e15", [](L& l) { l.damping = -1; });
    expect_link_fault("/limits", "from 0 to 1e9", [](L& l) { l.longest = kNan; });
    expect_link_fault("/limits", "from 0 to 1e9", [](L& l) { l.shortest = -1; });
    expect_link_fault("/limits", "above the longest", [](L& l) { l.shortest = 2, l.longest = 1; });
    expect_link_fault("/length", "has no direction", [](L& l) { l.shortest = l.longest = 0; });
}

TEST(DeformableFaults, OfAttachments) {
    const auto said = [](const AttachmentSpec& spec) {
        const auto fault = attachment_fault(scene_of_cloth(), spec);
        return fault ? fault->place + ": " + fault->sentence : "none";
    };
    EXPECT_EQ(said({1, {0}, kNoIndex, 0}), "/deformable: there is no deformable number 1");
    EXPECT_EQ(said({0, {0}, 2, 0}), "/to: there is no body number 2");
    EXPECT_EQ(said({0, {}, kNoIndex, 0}), "/points: there are no points to attach");
    EXPECT_EQ(said({0, {0, 3}, kNoIndex, 0}),
              "/points/1: there is no point 3; \"sheet\" has 3, numbered from 0");
    EXPECT_EQ(said({0, {0, 0}, kNoIndex, 0}), "/points/1: point 0 stands in the list twice");
    EXPECT_EQ(said({0, {0}, kNoIndex, kNan}), "/compliance: must be from 0 to 1e15");
}

TEST(DeformableFaults, PointsAtOnePlaceAreFoundInAnyOrder) {
    const std::vector<Eigen::Vector3d> points = {{1, 1, 1}, {0, 0, 0}, {1, 1, 1 + 1e-12},
                                                 {2, 0, 0}, {0, 0, 0}, {1, 1, 1}};
    EXPECT_EQ(first_at_place(points, 1e-9), (std::vector<std::uint32_t>{0, 1, 0, 3, 1, 0}));
    EXPECT_TRUE(first_at_place({}, 1e-9).empty());
}

}  // namespace plumb::test
