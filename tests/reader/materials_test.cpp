// SPDX-License-Identifier: MIT
#include "reading.h"

namespace plumb::test {

TEST(Materials, FillAllMembers) {
    const Scene scene = scene_of(R"({
        "materials": {"default": {"friction": 0.1},
                      "rubber": {"density": 900, "friction": 0.9, "restitution": 0.7, "rolling_friction": 0.01,
                                 "spinning_friction": 0.02}},
        "material_pairs": [{"between": ["rubber", "default"], "friction": 0.3}],
        "bodies": [{"shape": {"sphere": {"radius": 1}}, "material": "rubber"},
                   {"shape": {"sphere": {"radius": 1}}}]})");
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].friction, 0.1);
    EXPECT_EQ(scene.materials[0].density, 1000);
    const Material& rubber = scene.materials[1];
    EXPECT_EQ(rubber.name, "rubber");
    EXPECT_EQ(rubber.density, 900);
    EXPECT_EQ(rubber.restitution, 0.7);
    EXPECT_EQ(rubber.rolling_friction, 0.01);
    EXPECT_EQ(rubber.spinning_friction, 0.02);
    EXPECT_EQ(scene.bodies[0].material, 1u);
    EXPECT_EQ(scene.bodies[1].material, 0u);

    ASSERT_EQ(scene.material_pairs.size(), 1u);
    EXPECT_EQ(scene.material_pairs[0].a, 1u);
    EXPECT_EQ(scene.material_pairs[0].b, 0u);
    EXPECT_EQ(scene.material_pairs[0].friction, 0.3);
    EXPECT_FALSE(scene.material_pairs[0].restitution.has_value());
}

TEST(Materials, RefuseImpossibleCoefficients) {
    expect_error(R"({"materials": {"a": {"friction": -0.1}}})", "/materials/a/friction", "from 0");
    expect_error(R"({"materials": {"a": {"restitution": 1.01}}})", "/materials/a/restitution",
                 "from 0 to 1");
    expect_error(R"({"materials": {"a": {"density": 0}}})", "/materials/a/density", "above 0");
    expect_error(R"({"materials": {"a": {"frction": 1}}})", "/materials/a/frction", "\"friction\"");
}

TEST(Materials, RefuseUnknownNames) {
    expect_error(R"({"materials": {"wood": {}}, "bodies": [{"material": "woood"}]})",
                 "/bodies/0/material", "did you mean \"wood\"?");
    expect_error(R"({"material_pairs": [{"between": ["default", "ice"]}]})",
                 "/material_pairs/0/between/1", "there is no material named \"ice\"");
}

TEST(Materials, RefuseAPairThatStandsTwice) {
    expect_error(R"({"materials": {"a": {}, "b": {}},
                     "material_pairs": [{"between": ["a", "b"]}, {"between": ["b", "a"]}]})",
                 "/material_pairs/1", "twice");
}

}  // namespace plumb::test
